// SPDX-License-Identifier: Apache-2.0
#include "base/local_plane.h"

#include <cmath>

#include "base/angles.h"

namespace navcal::base {
namespace {

/// WGS84.
constexpr double kEquator_m = 6'378'137, kEccentricity2 = 6.69437999014e-3;

}  // namespace

LocalPlane::LocalPlane(double latitude_rad, double longitude_rad)
    : latitude_rad_(latitude_rad), longitude_rad_(longitude_rad) {
  const double sine = std::sin(latitude_rad);
  const double shrink = 1 - kEccentricity2 * sine * sine;
  const double across_m = kEquator_m / std::sqrt(shrink);
  north_m_ = across_m * (1 - kEccentricity2) / shrink;
  east_m_ = across_m * std::cos(latitude_rad);
}

std::array<double, 2> LocalPlane::position_m(double latitude_rad, double longitude_rad) const {
  return {north_m_ * (latitude_rad - latitude_rad_), east_m_ * base::wrapped(longitude_rad - longitude_rad_)};
}

LocalPlane::Place LocalPlane::place(double north_m, double east_m) const {
  return {latitude_rad_ + north_m / north_m_, base::wrapped(longitude_rad_ + east_m / east_m_)};
}

}  // namespace navcal::base
