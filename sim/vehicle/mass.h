// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/vehicle.h"
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

/// M = M_RB + M_A about the origin, kg, kg m, kg m2: the centre of gravity lies below the origin, so surge couples
/// with pitch and sway with roll. The vehicle is neutrally buoyant: the mass displaced is its own.
[[nodiscard]] Matrix6 mass_matrix(const config::HullSettings& hull);

}  // namespace navcal::sim
