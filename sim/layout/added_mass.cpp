// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/added_mass.h"

#include <cmath>
#include <numbers>

#include "sim/layout/vector_of.h"

namespace navcal::sim {
namespace {

Matrix6 spheroid_added_mass(const config::LayoutSpheroid& spheroid, double density_kg_m3) {
  const double L = spheroid.length_m, D = spheroid.diameter_m;
  const double displaced_kg = density_kg_m3 * std::numbers::pi / 6 * L * D * D;
  const double inertia_kg_m2 = displaced_kg * (L * L + D * D) / 20;
  const LambFactors lamb = lamb_factors(L, D);
  Vector6 diagonal;
  diagonal << lamb.axial * displaced_kg, lamb.transverse * displaced_kg, lamb.transverse * displaced_kg, 0,
      lamb.rotational * inertia_kg_m2, lamb.rotational * inertia_kg_m2;
  return diagonal.asDiagonal();
}

void add_strips(const config::LayoutStrips& strips, double density_kg_m3, Matrix6& mass) {
  for (std::size_t i = 0; i < strips.x_m.size(); ++i) {
    const double x = strips.x_m[i];
    const double per_area = density_kg_m3 * std::numbers::pi / 4 * strips.length_m[i];
    const double heave = per_area * strips.width_m[i] * strips.width_m[i];
    const double sway = per_area * strips.height_m[i] * strips.height_m[i];
    mass(1, 1) += sway;
    mass(2, 2) += heave;
    mass(4, 4) += x * x * heave;
    mass(5, 5) += x * x * sway;
    mass(1, 5) += x * sway;
    mass(5, 1) += x * sway;
    mass(2, 4) -= x * heave;
    mass(4, 2) -= x * heave;
  }
}

}  // namespace

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

Matrix6 added_mass(const config::Layout& layout) {
  Matrix6 mass = matrix_of(layout.added_mass.matrix_kg);
  if (layout.added_mass.spheroid)
    mass += spheroid_added_mass(*layout.added_mass.spheroid, layout.water_density_kg_m3);
  add_strips(layout.added_mass.strips, layout.water_density_kg_m3, mass);
  return mass;
}

}  // namespace navcal::sim
