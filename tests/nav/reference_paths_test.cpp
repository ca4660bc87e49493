// SPDX-License-Identifier: Apache-2.0
// The thesis's kinds of manoeuvre as our vehicle model ran them: fixes for fifteen seconds, then none to the end.
// Heading errors are those of the thesis (5, -5, 2, 2 degrees, gyros 0.9 and 0.1 rad/s): as they are, and with
// them taken away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "nav/navigator.h"
#include "tests/nav/drive.h"

namespace navcal::nav::test {
namespace {

double thesis_deviation_rad(double heading_rad) {
  return (5 * std::sin(heading_rad) - 5 * std::cos(heading_rad) + 2 * std::sin(2 * heading_rad) +
          2 * std::cos(2 * heading_rad)) *
         kDegree;
}

struct Result {
  double distance_m = 0, error_m = 0, depth_error_m = 0, tilt_error_rad = 0;
};

Result run(const std::string& name, double duration_s, bool calibrated) {
  const auto way = reference_way(name);
  DriveOptions drive;
  drive.fixed = [](double t_s) { return t_s < 15; };
  if (!calibrated) {
    drive.compass_says = [](double heading_rad) { return heading_rad + thesis_deviation_rad(heading_rad); };
    drive.zero_rad_s.z() = 0.02;
  }
  Navigator navigator({});
  Result result;
  for (const auto& arrived : readings_along(way, duration_s, drive)) {
    give(navigator, arrived.reading);
    if (since_start_s(arrived.arrival_ns) < 15) continue;
    const auto estimate = navigator.estimate();
    const auto truth = way.at(estimate.time_ns);
    result.depth_error_m = std::max(result.depth_error_m, std::abs(*estimate.depth_m - truth.position_m[2]));
    result.tilt_error_rad = std::max({result.tilt_error_rad, std::abs(*estimate.roll_rad - truth.euler_rad[0]),
                                      std::abs(*estimate.pitch_rad - truth.euler_rad[1])});
  }
  result.distance_m = navigator.estimate().since_fix_m;
  result.error_m = position_error_m(navigator, way);
  return result;
}

TEST(ReferencePaths, CalibrationTakesTheLargerPartOfTheError) {
  double distance_m = 0, before_m = 0, after_m = 0;
  for (int path = 1; path <= 9; ++path) {
    const std::string name = path == 9 ? "path_long600" : "path" + std::to_string(path);
    const double duration_s = path == 9 ? 600 : 50;
    const auto before = run(name, duration_s, false), after = run(name, duration_s, true);
    std::printf("%-14s %5.0f m  before %5.2f m, after %5.2f m per 100 m; depth %.3f m, tilt %.2f deg\n",
                name.c_str(), after.distance_m, 100 * before.error_m / before.distance_m,
                100 * after.error_m / after.distance_m, after.depth_error_m, after.tilt_error_rad / kDegree);
    EXPECT_LT(after.error_m, 0.15 * after.distance_m) << name;
    EXPECT_LT(after.depth_error_m, 0.05) << name;
    EXPECT_LT(after.tilt_error_rad, 1.5 * kDegree) << name;
    distance_m += after.distance_m;
    before_m += before.error_m;
    after_m += after.error_m;
  }
  EXPECT_LT(after_m, 0.7 * before_m);
  EXPECT_LT(after_m, 0.05 * distance_m);
}

}  // namespace
}  // namespace navcal::nav::test
