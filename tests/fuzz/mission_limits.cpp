// SPDX-License-Identifier: Apache-2.0
// Whatever a file of limits has in it: limits within their ranges, or problems with their lines.
#include "config/mission_limits.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const navcal::config::MissionLimits limits =
        navcal::config::parse_mission_limits({reinterpret_cast<const char*>(data), size}, "limits.toml");
    const bool is_sound = limits.duration_s > 0 && limits.least_depth_m < limits.greatest_depth_m &&
                          limits.least_shaft_rps < limits.greatest_shaft_rps && std::isfinite(limits.radius_m);
    if (!is_sound) std::abort();
  } catch (const navcal::config::Error&) {
  }
  return 0;
}
