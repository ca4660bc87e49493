// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/vehicle.h"

namespace navcal::autopilot {

/// The shaft speed in rev/s at which the thrust rho n^2 D^4 (KT0 + KT1 J) equals a drag of `drag_kg_m` u^2, u > 0.
[[nodiscard]] double shaft_for(const config::PropellerSettings& propeller, double density_kg_m3, double surge_m_s,
                               double drag_kg_m);

}  // namespace navcal::autopilot
