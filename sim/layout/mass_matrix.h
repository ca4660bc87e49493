// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/vectors.h"
#include "config/layout.h"
#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

using base::vector_of;

[[nodiscard]] inline Matrix6 matrix_of(const config::LayoutMatrix& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data());
}

/// Lamb's inertia coefficients of a prolate spheroid (Lamb, Hydrodynamics, articles 114 and 115; Fossen, Handbook
/// of Marine Craft Hydrodynamics and Motion Control, 2011, chapter 6): added mass over displaced mass along the
/// axis and across it, added inertia over displaced inertia about a transverse axis.
struct LambFactors {
  double axial, transverse, rotational;
};

/// Lamb's factors of a spheroid `length_m` long and `diameter_m` thick; the length must be the greater.
[[nodiscard]] LambFactors lamb_factors(double length_m, double diameter_m);

/// M_A about the origin, kg, kg m, kg m2, positive on the diagonal (M_A(0,0) = -X_udot): the sum of
/// - the file's matrix;
/// - a prolate spheroid about the origin with Lamb's factors on the mass it displaces;
/// - strip theory (Fossen 2011, chapter 6; Newman 1977, chapter 4): a strip at x, dx long, w wide (y) and h high
/// (z),
///   taken as an ellipse, adds a_z = rho pi w^2/4 dx in heave and a_y = rho pi h^2/4 dx in sway, and about the
///   origin M_A(2,4) -= x a_z, M_A(4,4) += x^2 a_z, M_A(1,5) += x a_y, M_A(5,5) += x^2 a_y. Surge and roll:
///   nothing.
[[nodiscard]] Matrix6 added_mass(const config::Layout& layout);

/// Skew-symmetric matrix S(a) with S(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Symmetric matrix of inertia about the centre of gravity, kg m2.
[[nodiscard]] Eigen::Matrix3d inertia_matrix(const config::LayoutBody& body);

/// M_RB about the origin (Fossen 2011, equation 3.44), kg, kg m, kg m2:
///   M_RB = [ m 1, -m S(r_g); m S(r_g), I_g - m S(r_g) S(r_g) ].
/// Moving masses at these places along their axes (m): r_g moves by sum m_i s_i a_i / m, and the inertia about the
/// origin by the difference of their point masses' own, -m_i (S(r_i')^2 - S(r_i)^2).
[[nodiscard]] Matrix6 rigid_body_mass(const config::Layout& layout, const ActuatorNumbers& masses_m);

/// Centre of gravity with moving masses at these places, m.
[[nodiscard]] Eigen::Vector3d gravity_centre_m(const config::Layout& layout, const ActuatorNumbers& masses_m);

}  // namespace navcal::sim
