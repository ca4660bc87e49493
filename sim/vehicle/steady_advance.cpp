// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/steady_advance.h"

#include <numbers>

#include "sim/vehicle/propeller.h"

namespace navcal::sim {

double steady_advance_m(const config::VehicleSettings& vehicle) {
  const double midship_m2 = std::numbers::pi * vehicle.hull.diameter_m * vehicle.hull.diameter_m / 4;
  const double drag_kg_m = 0.5 * vehicle.water.density_kg_m3 * vehicle.hull.axial_drag * midship_m2;
  constexpr double kSpeed_m_s = 1;  // any
  return kSpeed_m_s / Propeller(vehicle.propeller, vehicle.water).shaft_for(kSpeed_m_s, drag_kg_m);
}

}  // namespace navcal::sim
