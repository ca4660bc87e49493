// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/propeller.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {

Propeller::Propeller(const config::PropellerSettings& propeller, const config::WaterSettings& water)
    : settings_(propeller), density_kg_m3_(water.density_kg_m3) {}

Propeller::Force Propeller::at(double surge_m_s, double shaft_rps) const {
  if (!(shaft_rps > 0)) return {0, 0};
  const double D = settings_.diameter_m;
  const double advance = std::max(surge_m_s, 0.0) / (shaft_rps * D);
  const double KT = std::max(settings_.thrust_at_rest + settings_.thrust_slope * advance, 0.0);
  const double scale_N = density_kg_m3_ * shaft_rps * shaft_rps * D * D * D * D;
  return {scale_N * KT, settings_.torque_felt * scale_N * D * settings_.torque};
}

double current_A(const config::PropellerSettings& propeller, double shaft_rps) {
  const double n = std::max(shaft_rps, 0.0);
  return propeller.idle_current_A + propeller.current_A_s3 * n * n * n;
}

}  // namespace navcal::sim
