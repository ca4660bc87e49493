// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "config/layout.h"
#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Weight and buoyancy (Fossen 2011, chapter 4). With d the unit vector downwards in body axes, W the weight at
/// r_g, B the buoyancy at r_b and b_i the buoyancy that ballast i adds at r_i:
///   force = (W - B - sum b_i) d,   moment = (W r_g - B r_b - sum b_i r_i) x d.
struct Restoring {
  double net_weight_N = 0;   ///< W - B - sum b_i
  Eigen::Vector3d arm_Nm{};  ///< W r_g - B r_b - sum b_i r_i

  void add(const Eigen::Vector3d& down, Vector6& force) const {
    force.head<3>() += net_weight_N * down;
    force.tail<3>() += arm_Nm.cross(down);
  }
};

/// Ballasts at these added buoyancies (N), moving masses at these places along their axes (m).
[[nodiscard]] Restoring restoring_of(const config::Layout& layout, const ActuatorNumbers& ballasts_N,
                                     const ActuatorNumbers& masses_m);

/// Downwards in body axes at these Euler angles.
[[nodiscard]] Eigen::Vector3d down_of(const Eigen::Vector3d& euler_rad);

}  // namespace navcal::sim
