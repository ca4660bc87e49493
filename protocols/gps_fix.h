// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>

#include <iterator>
#include <string_view>

namespace navcal::api {

/// "none", "2d", "3d", "propagated", "hold", "acquiring", "bad_geometry" (docs/cli.md).
[[nodiscard]] constexpr std::string_view name_of(Fix fix) {
  constexpr std::string_view kNames[] = {"none", "2d", "3d", "propagated", "hold", "acquiring", "bad_geometry"};
  const auto place = static_cast<std::size_t>(fix);
  return kNames[place < std::size(kNames) ? place : 0];
}

}  // namespace navcal::api

namespace navcal::protocols {

using api::Fix;

}  // namespace navcal::protocols
