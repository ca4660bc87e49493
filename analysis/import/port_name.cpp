// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/port_name.h"

#include <algorithm>
#include <array>
#include <string>

namespace navcal::analysis {
namespace {

constexpr std::array<std::string_view, 12> kNames{"imu",  "compass",  "gps",   "depth",   "dvl",      "altimeter",
                                                  "baro", "attitude", "motor", "battery", "velocity", "sensors"};
constexpr std::size_t kInstances = 9;

const auto& all_names() {
  static const auto names = [] {
    std::array<std::array<std::string, kInstances>, kNames.size()> made;
    for (std::size_t kind = 0; kind < made.size(); ++kind) {
      for (std::size_t i = 0; i < kInstances; ++i)
        made[kind][i] = std::string(kNames[kind]) + (i == 0 ? "" : std::to_string(i + 1));
    }
    return made;
  }();
  return names;
}

}  // namespace

std::string_view port_name(PortKind kind, int instance) {
  const auto place = static_cast<std::size_t>(std::clamp<int>(instance, 0, kInstances - 1));
  return all_names()[static_cast<std::size_t>(kind)][place];
}

std::size_t port_rank(std::string_view name) {
  std::size_t rank = 0;
  for (const auto& of_kind : all_names()) {
    for (const std::string& known : of_kind) {
      if (known == name) return rank;
      ++rank;
    }
  }
  return rank;
}

}  // namespace navcal::analysis
