// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/rigid_body.h"

#include "sim/layout/vector_of.h"

namespace navcal::sim {

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
