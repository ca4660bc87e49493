// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/mass_matrix.h"

#include <cmath>
#include <numbers>

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

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

Eigen::Matrix3d inertia_matrix(const config::LayoutBody& body) {
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kg_m2;
  Eigen::Matrix3d inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return inertia;
}

Eigen::Vector3d gravity_centre_m(const config::Layout& layout, const ActuatorNumbers& masses_m) {
  Eigen::Vector3d centre = vector_of(layout.body.gravity_centre_m);
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i) {
    const config::LayoutMovingMass& mass = layout.moving_masses[i];
    centre += mass.mass_kg / layout.body.mass_kg * masses_m[i] * vector_of(mass.axis).normalized();
  }
  return centre;
}

Matrix6 rigid_body_mass(const config::Layout& layout, const ActuatorNumbers& masses_m) {
  const double m = layout.body.mass_kg;
  const Eigen::Matrix3d S = skew(vector_of(layout.body.gravity_centre_m));
  Eigen::Matrix3d about_origin = inertia_matrix(layout.body) - m * S * S;
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i) {
    const config::LayoutMovingMass& mass = layout.moving_masses[i];
    const Eigen::Vector3d before = vector_of(mass.place_m);
    const Eigen::Matrix3d S0 = skew(before);
    const Eigen::Matrix3d S1 = skew(before + masses_m[i] * vector_of(mass.axis).normalized());
    about_origin -= mass.mass_kg * (S1 * S1 - S0 * S0);
  }
  const Eigen::Matrix3d coupling = m * skew(gravity_centre_m(layout, masses_m));
  Matrix6 mass = Matrix6::Zero();
  mass.topLeftCorner<3, 3>().diagonal().setConstant(m);
  mass.topRightCorner<3, 3>() = -coupling;
  mass.bottomLeftCorner<3, 3>() = coupling;
  mass.bottomRightCorner<3, 3>() = about_origin;
  return mass;
}

}  // namespace navcal::sim
