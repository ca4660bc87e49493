// SPDX-License-Identifier: Apache-2.0
#include "base/local_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"

namespace navcal::base {
namespace {

TEST(LocalPlane, GoesThereAndBack) {
  for (const double latitude_deg : {-70.0, 0.0, 37.0}) {
    for (const double longitude_deg : {-180.0, 0.0, 179.9999}) {
      const LocalPlane plane(latitude_deg * kRadiansPerDegree, longitude_deg * kRadiansPerDegree);
      const auto place = plane.place(1234, -567);
      const auto [north_m, east_m] = plane.position_m(place.latitude_rad, place.longitude_rad);
      EXPECT_NEAR(north_m, 1234, 1e-6);
      EXPECT_NEAR(east_m, -567, 1e-6);
      EXPECT_LE(std::abs(place.longitude_rad), std::numbers::pi);
    }
  }
}

TEST(LocalPlane, AMinuteOfLatitudeIsANauticalMile) {
  const LocalPlane plane(45 * kRadiansPerDegree, 0);
  EXPECT_NEAR(plane.position_m(45 * kRadiansPerDegree + kRadiansPerDegree / 60, 0)[0], 1852, 1);
  EXPECT_NEAR(plane.position_m(45 * kRadiansPerDegree, kRadiansPerDegree / 60)[1],
              1852 * std::cos(45 * kRadiansPerDegree), 5);
}

}  // namespace
}  // namespace navcal::base
