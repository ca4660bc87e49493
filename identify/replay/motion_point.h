// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

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

/// Tilt that a sensor with a first-order lag shows a step later: exact where the tilt is linear over the step.
[[nodiscard]] Eigen::Vector2d lagged_tilt(const Eigen::Vector2d& shown, const Eigen::Vector2d& then,
                                          const Eigen::Vector2d& now, double lag_s, double step_s);

/// Sets what the readings next to a time measure: position, attitude, rates, and the velocity of a Doppler log.
/// All else stays as it is, but for the lagged tilt, which becomes that of the body.
void measure_state(const RecordedMotion& motion, double time_s, StateVector& state);

}  // namespace navcal::identify
