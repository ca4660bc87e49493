// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/mass.h"

#include <cmath>

namespace navcal::sim {

LambFactors lamb_factors(double length_m, double diameter_m) {
  const double e2 = 1 - std::pow(diameter_m / length_m, 2);
  const double e = std::sqrt(e2);
  const double logarithm = std::log((1 + e) / (1 - e));
  const double alpha = 2 * (1 - e2) / (e2 * e) * (logarithm / 2 - e);
  const double beta = 1 / e2 - (1 - e2) / (2 * e2 * e) * logarithm;
  const double difference = beta - alpha;
  return {alpha / (2 - alpha), beta / (2 - beta),
          e2 * e2 * difference / ((2 - e2) * (2 * e2 - (2 - e2) * difference))};
}

Matrix6 mass_matrix(const config::HullSettings& hull) {
  const double m = hull.mass_kg;
  const double zg = hull.gravity_below_m;
  const double b = hull.diameter_m / 2;
  const double roll = hull.roll_inertia_factor * m * b * b;
  const double pitch = hull.pitch_inertia_factor * m * (hull.length_m * hull.length_m / 12 + b * b / 4);
  const LambFactors lamb = lamb_factors(hull.length_m, hull.diameter_m);
  Vector6 diagonal;
  diagonal << m * (1 + lamb.axial), m * (1 + lamb.transverse), m * (1 + lamb.transverse),
      (1 + hull.roll_added_factor) * roll + m * zg * zg, (1 + lamb.rotational) * pitch + m * zg * zg,
      (1 + lamb.rotational) * pitch;
  Matrix6 mass = diagonal.asDiagonal();
  mass(0, 4) = mass(4, 0) = m * zg;
  mass(1, 3) = mass(3, 1) = -m * zg;
  return mass;
}

}  // namespace navcal::sim
