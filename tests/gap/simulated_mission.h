// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "gap/data/mission.h"

namespace navcal::gap::test {

/// A capture of a shipped mission's first seconds, by a vehicle with these effects (TOML).
void write_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                   double seconds, std::uint64_t seed);

/// The same as read back.
[[nodiscard]] Mission simulated_mission(std::string_view mission, std::string_view effects, double seconds,
                                        std::uint64_t seed);

}  // namespace navcal::gap::test
