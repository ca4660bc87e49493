// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/data/actuator_inputs.h"
#include "identify/data/recorded_motion.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::identify {

/// Position, Euler angles, body velocity and rates as sim::Body has them, then roll and pitch of a tilt sensor
/// that lags: 14 numbers, SI.
inline constexpr Eigen::Index kStates = 14;
using StateVector = Eigen::Matrix<double, kStates, 1>;

/// The motion at one instant. Position and velocity are relative to the water.
struct MotionPoint {
  sim::Body body;
  sim::Vector6 acceleration = sim::Vector6::Zero();    ///< nu'
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();  ///< roll and pitch through the sensor's first-order lag
};

/// Rotation of a vector from the body to the world, by roll, pitch and yaw.
[[nodiscard]] Eigen::Matrix3d world_from_body(const Eigen::Vector3d& euler_rad);
/// Within what any vehicle does: pitch below 88 degrees, below 50 m/s and 50 rad/s, and all numbers finite.
[[nodiscard]] bool is_sane(const sim::Body& body);
[[nodiscard]] MotionPoint point_of(const StateVector& state);

/// A motion at equal steps of time.
struct ReplayedMotion {
  static constexpr double kStep_s = 0.01;

  double begin_s = 0;
  std::vector<MotionPoint> points;  ///< one at the begin of each step, and one at the end of the last

  /// Velocity by cubic interpolation with the accelerations, all else linear.
  [[nodiscard]] MotionPoint at(double time_s) const;
};

/// Fills in the lagged tilt of all points but the first.
void add_lagged_tilt(ReplayedMotion& motion, double lag_s);

/// Sets what the readings next to a time measure: position, attitude, rates, and the velocity of a Doppler log.
/// All else stays as it is, but for the lagged tilt, which becomes that of the body.
void measure_state(const RecordedMotion& motion, double time_s, StateVector& state);

}  // namespace navcal::identify
