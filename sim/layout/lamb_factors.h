// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::sim {

/// Lamb's inertia coefficients of a prolate spheroid (Lamb, Hydrodynamics, articles 114 and 115; Fossen, Handbook
/// of Marine Craft Hydrodynamics and Motion Control, 2011, chapter 6): added mass over displaced mass along the
/// axis and across it, added inertia over displaced inertia about a transverse axis.
struct LambFactors {
  double axial, transverse, rotational;
};

/// Lamb's factors of a spheroid `length_m` long and `diameter_m` thick; the length must be the greater.
[[nodiscard]] LambFactors lamb_factors(double length_m, double diameter_m);

}  // namespace navcal::sim
