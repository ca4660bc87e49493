// SPDX-License-Identifier: Apache-2.0
#include "autopilot/shaft_speed.h"

#include <cmath>

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

}  // namespace navcal::autopilot
