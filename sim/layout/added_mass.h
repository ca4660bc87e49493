// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// M_A about the origin, kg, kg m, kg m2, positive on the diagonal (M_A(0,0) = -X_udot): the sum of
/// - the file's matrix;
/// - a prolate spheroid about the origin with Lamb's factors (sim/layout/lamb_factors.h) on the mass it displaces;
/// - strip theory (Fossen 2011, chapter 6; Newman 1977, chapter 4): a strip at x, dx long, w wide (y) and h high
/// (z),
///   taken as an ellipse, adds a_z = rho pi w^2/4 dx in heave and a_y = rho pi h^2/4 dx in sway, and about the
///   origin M_A(2,4) -= x a_z, M_A(4,4) += x^2 a_z, M_A(1,5) += x a_y, M_A(5,5) += x^2 a_y. Surge and roll:
///   nothing.
[[nodiscard]] Matrix6 added_mass(const config::Layout& layout);

}  // namespace navcal::sim
