// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace navcal::protocols {

/// Kind of a receiver's position.
enum class Fix : std::uint8_t {
  none,
  fix_2d,  ///< height held
  fix_3d,
  propagated,    ///< carried on without satellites
  hold,          ///< position hold: a known place is held to find the time; speed, heading and DOP are void
  acquiring,     ///< looking for satellites
  bad_geometry,  ///< satellites stand too badly for a position
};

/// "none", "2d", "3d", "propagated", "hold", "acquiring", "bad_geometry" (docs/cli.md).
[[nodiscard]] constexpr std::string_view name_of(Fix fix) {
  switch (fix) {
    case Fix::none: return "none";
    case Fix::fix_2d: return "2d";
    case Fix::fix_3d: return "3d";
    case Fix::propagated: return "propagated";
    case Fix::hold: return "hold";
    case Fix::acquiring: return "acquiring";
    case Fix::bad_geometry: return "bad_geometry";
  }
  return "none";
}

}  // namespace navcal::protocols
