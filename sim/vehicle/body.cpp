// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/body.h"

#include <fmt/format.h>

#include <cmath>

#include "base/angles.h"

namespace navcal::sim {

void check_stable(const Body& body, double time_s) {
  constexpr double kFastest_m_s = 50;
  constexpr double kFastest_rad_s = 50;
  constexpr double kSteepest_rad = 88 / base::kDegreesPerRadian;
  const char* why = nullptr;
  // Written so that NaN fails.
  if (!body.position_m.allFinite() || !(body.velocity.head<3>().norm() < kFastest_m_s) ||
      !(body.velocity.tail<3>().norm() < kFastest_rad_s)) {
    why = "went unstable";
  } else if (!(std::abs(body.euler_rad[1]) < kSteepest_rad)) {
    why = "stands on end, beyond what Euler angles describe,";
  }
  if (why == nullptr) return;
  const auto& v = body.velocity;
  throw UnstableVehicle(fmt::format(
      "the vehicle {} at t = {:.2f} s: roll {:.1f}, pitch {:.1f}, yaw {:.1f} deg, u, v, w = {:.3g}, {:.3g}, "
      "{:.3g} m/s, p, q, r = {:.3g}, {:.3g}, {:.3g} rad/s, depth {:.2f} m",
      why, time_s, body.euler_rad[0] * base::kDegreesPerRadian, body.euler_rad[1] * base::kDegreesPerRadian,
      body.euler_rad[2] * base::kDegreesPerRadian, v[0], v[1], v[2], v[3], v[4], v[5], body.position_m.z()));
}

}  // namespace navcal::sim
