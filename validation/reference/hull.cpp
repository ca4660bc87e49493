// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/hull.h"

#include <cmath>

namespace navcal::reference {
namespace {

/// Lamb's coefficients: added mass along and across, added inertia across.
struct Spheroid {
  double along, across, turning;
};

Spheroid lamb(double half_length_m, double radius_m) {
  const double slenderness2 = (radius_m / half_length_m) * (radius_m / half_length_m);  // 1 - e^2
  const double e2 = 1 - slenderness2;
  const double e = std::sqrt(e2);
  const double logarithm = std::log1p(e) - std::log1p(-e);
  const double alpha = slenderness2 / (e2 * e) * (logarithm - 2 * e);
  const double beta = 1 / e2 - slenderness2 / (2 * e2 * e) * logarithm;
  const double excess = beta - alpha;
  return {alpha / (2 - alpha), beta / (2 - beta), e2 * e2 * excess / ((2 - e2) * (2 * e2 - (2 - e2) * excess))};
}

}  // namespace

Matrix6 inertia(const Hull& hull) {
  const double m = hull.mass_kg, drop = hull.gravity_centre_below_m, b = hull.diameter_m / 2;
  const double roll = hull.roll_inertia_factor * m * b * b;
  const double yaw = hull.pitch_inertia_factor * m * (hull.length_m * hull.length_m / 12 + b * b / 4);
  const Spheroid water = lamb(hull.length_m / 2, b);

  Matrix6 M = Matrix6::Zero();
  M.diagonal() << m * (1 + water.along), m * (1 + water.across), m * (1 + water.across),
      roll * (1 + hull.roll_added_inertia) + m * drop * drop, yaw * (1 + water.turning) + m * drop * drop,
      yaw * (1 + water.turning);
  // The centre of gravity moves with omega x (0, 0, drop) = drop * (q, -p, 0) against the origin.
  M(0, 4) = M(4, 0) = m * drop;
  M(1, 3) = M(3, 1) = -m * drop;
  return M;
}

}  // namespace navcal::reference
