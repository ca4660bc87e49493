// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

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

}  // namespace navcal::sim
