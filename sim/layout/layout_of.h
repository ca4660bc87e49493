// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "config/vehicle.h"

namespace navcal::sim {

/// A vehicle file of one propeller and three fins as a layout. LayoutVehicle moves as Vehicle does, but for the
/// order of floating-point operations. Fins are named "fin_1" to "fin_3", the propeller "propeller"; its limits
/// are the autopilot's.
[[nodiscard]] config::Layout layout_of(const config::VehicleSettings& vehicle);

}  // namespace navcal::sim
