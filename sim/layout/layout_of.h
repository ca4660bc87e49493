// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "config/vehicle.h"
#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// A vehicle file of one propeller and three fins as a layout. Fins are named "fin_1" to "fin_3", the propeller
/// "propeller"; its limits are the autopilot's. The fins stand about the tail, 120 degrees apart: the first up,
/// the second to starboard and down, the third to port and down; each at r = (x, R y, R z) has its normal along
/// (0, -z, y).
[[nodiscard]] config::Layout layout_of(const config::VehicleSettings& vehicle);

/// Positions of the actuators of such a vehicle.
struct Controls {
  Eigen::Vector3d fins_rad = Eigen::Vector3d::Zero();
  double shaft_rps = 0;

  /// The same as positions in its layout.
  [[nodiscard]] ActuatorValues values() const {
    return {{60 * shaft_rps}, {fins_rad[0], fins_rad[1], fins_rad[2]}, {}, {}};
  }
};

}  // namespace navcal::sim
