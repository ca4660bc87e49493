// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"

namespace navcal::reference {

/// The vehicle at one instant: SI, body axes x forward, y starboard, z down, world north, east, down.
struct Snapshot {
  double time_s = 0;  ///< since the mission began
  Vector3 position_m = Vector3::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Vector3 velocity_m_s = Vector3::Zero();                 ///< through the water, body axes
  Vector3 rate_rad_s = Vector3::Zero();                   ///< body axes
  Vector3 acceleration_m_s2 = Vector3::Zero();            ///< of the origin against the world, body axes
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();  ///< of the water, north and east
  Vector3 servos_rad = Vector3::Zero();                   ///< of the fin servos' shafts
  double shaft_rev_s = 0;
  double motor_current_A = 0;
  double supply_loss = 0;  ///< relative, of the battery
  double electronics_C = 0;
  double gravity_m_s2 = kGravity_m_s2;  ///< local

  /// Unit vector downwards, body axes.
  [[nodiscard]] Vector3 down() const { return world_from_body.conjugate() * Vector3::UnitZ(); }
  /// Against the ground, world axes.
  [[nodiscard]] Vector3 ground_velocity_m_s() const {
    return world_from_body * velocity_m_s + Vector3(current_m_s.x(), current_m_s.y(), 0);
  }
  /// Clockwise from north, -pi to pi.
  [[nodiscard]] double heading_rad() const;
  [[nodiscard]] double pitch_rad() const;
  [[nodiscard]] double roll_rad() const;
};

/// Attitude of these angles.
[[nodiscard]] Eigen::Quaterniond attitude(double roll_rad, double pitch_rad, double heading_rad);

/// Straight between two snapshots a few milliseconds apart; `part` 0 is the first, 1 the second.
[[nodiscard]] Snapshot between(const Snapshot& first, const Snapshot& second, double part);

}  // namespace navcal::reference
