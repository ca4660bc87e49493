// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/data/actuator_inputs.h"
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
[[nodiscard]] MotionPoint point_of(const StateVector& state);
[[nodiscard]] StateVector state_of(const MotionPoint& point);

/// The vehicle of a layout under recorded actuators from one state on, in steps of kReplayStep_s.
struct ReplayedMotion {
  static constexpr double kStep_s = 0.01;

  double begin_s = 0;
  std::vector<MotionPoint> points;  ///< one at the begin of each step, and one at the end of the last

  /// Velocity by cubic interpolation with the accelerations, all else linear.
  [[nodiscard]] MotionPoint at(double time_s) const;
  [[nodiscard]] const MotionPoint& end() const { return points.back(); }
};

/// Fills in the lagged tilt of all points but the first.
void add_lagged_tilt(ReplayedMotion& motion, double lag_s);

/// nullopt: the motion leaves all bounds (no number, pitch beyond 88 degrees, or speeds that no vehicle has).
/// The actuators are `delay_s` later than recorded. Without a lag of the tilt sensor its tilt is that of the body.
[[nodiscard]] std::optional<ReplayedMotion> replay(const sim::LayoutVehicle& vehicle,
                                                   const ActuatorTrajectory& actuators, double delay_s,
                                                   double begin_s, std::size_t steps, const StateVector& begin,
                                                   double tilt_lag_s);

}  // namespace navcal::identify
