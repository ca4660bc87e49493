// SPDX-License-Identifier: Apache-2.0
#include "autopilot/shaft_speed.h"

#include <cmath>
#include <numbers>

namespace navcal::autopilot {

double shaft_for(const config::PropellerSettings& propeller, double density_kg_m3, double surge_m_s,
                 double drag_kg_m) {
  // rho D^4 KT0 n^2 + rho D^3 KT1 u n - drag u^2 = 0, the greater root.
  const double D = propeller.diameter_m;
  const double a = density_kg_m3 * D * D * D * D * propeller.thrust_at_rest;
  const double b = density_kg_m3 * D * D * D * propeller.thrust_slope * surge_m_s;
  const double c = -drag_kg_m * surge_m_s * surge_m_s;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double axial_drag_kg_m(const config::VehicleSettings& vehicle) {
  return 0.5 * vehicle.water.density_kg_m3 * vehicle.hull.axial_drag * std::numbers::pi * vehicle.hull.diameter_m *
         vehicle.hull.diameter_m / 4;
}

double surge_for(const config::VehicleSettings& vehicle, double shaft_rps) {
  if (!(shaft_rps > 0)) return 0;
  // Inverts shaft_for(): the speed is proportional to the shaft speed.
  const double per_rps = shaft_for(vehicle.propeller, vehicle.water.density_kg_m3, 1, axial_drag_kg_m(vehicle));
  return shaft_rps / per_rps;
}

}  // namespace navcal::autopilot
