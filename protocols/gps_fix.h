// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>

#include <string_view>

namespace navcal::api {

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

}  // namespace navcal::api

namespace navcal::protocols {

using api::Fix;

}  // namespace navcal::protocols
