// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/vehicle.h"

namespace navcal::autopilot {

/// The shaft speed in rev/s at which the thrust rho n^2 D^4 (KT0 + KT1 J) equals a drag of `drag_kg_m` u^2, u > 0.
[[nodiscard]] double shaft_for(const config::PropellerSettings& propeller, double density_kg_m3, double surge_m_s,
                               double drag_kg_m);

/// The speed in m/s at which the vehicle's propeller at `shaft_rps` gives the thrust that equals the axial drag of
/// its hull; 0 when it does not turn forwards.
[[nodiscard]] double surge_for(const config::VehicleSettings& vehicle, double shaft_rps);

/// Axial drag over the square of the speed.
[[nodiscard]] double axial_drag_kg_m(const config::VehicleSettings& vehicle);

}  // namespace navcal::autopilot
