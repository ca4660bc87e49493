// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace navcal::base {

/// North and east in metres about an origin on the ellipsoid (WGS84): the tangent plane, scaled by the radii of
/// curvature at the origin. Off by the tangent of the latitude times distance over the Earth's radius: 0.16 % at
/// 10 km and 45 degrees. Radians.
class LocalPlane {
 public:
  LocalPlane(double latitude_rad, double longitude_rad);

  [[nodiscard]] std::array<double, 2> position_m(double latitude_rad, double longitude_rad) const;
  struct Place {
    double latitude_rad = 0, longitude_rad = 0;  ///< longitude -pi..pi
  };
  [[nodiscard]] Place place(double north_m, double east_m) const;

 private:
  double latitude_rad_, longitude_rad_;
  double north_m_, east_m_;  ///< of one radian
};

}  // namespace navcal::base
