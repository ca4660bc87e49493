// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "base/angles.h"
#include "sim/state.h"

namespace navcal::sim {

/// Geodetic position (WGS84) of north = east = down = 0. The default is a lake in Virginia.
struct Origin {
  double latitude_deg = 37.0629;
  double longitude_deg = -80.6275;
  double height_m = 562;
};

/// Latitude and longitude (within 180 degrees) in degrees and height of a place near the origin; exact to a
/// centimetre within some km.
[[nodiscard]] inline Vector3 geodetic(const Origin& origin, const Vector3& north_east_down_m) {
  constexpr double kSemiMajor_m = 6378137.0;
  constexpr double kEccentricity2 = 6.69437999014e-3;
  const double latitude = origin.latitude_deg / base::kDegreesPerRadian;
  const double s2 = kEccentricity2 * std::sin(latitude) * std::sin(latitude);
  const double meridian_m = kSemiMajor_m * (1 - kEccentricity2) / std::pow(1 - s2, 1.5) + origin.height_m;
  const double transverse_m = kSemiMajor_m / std::sqrt(1 - s2) + origin.height_m;
  return {origin.latitude_deg + north_east_down_m[0] / meridian_m * base::kDegreesPerRadian,
          std::remainder(origin.longitude_deg +
                             north_east_down_m[1] / (transverse_m * std::cos(latitude)) * base::kDegreesPerRadian,
                         360),
          origin.height_m - north_east_down_m[2]};
}

}  // namespace navcal::sim
