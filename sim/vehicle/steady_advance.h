// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/vehicle.h"

namespace navcal::sim {

/// Way through the water for one revolution of the shaft, straight ahead at a steady speed, m: where thrust equals
/// the axial drag. It does not depend on the speed.
[[nodiscard]] double steady_advance_m(const config::VehicleSettings& vehicle);

}  // namespace navcal::sim
