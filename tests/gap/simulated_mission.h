// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "gap/data/mission.h"

namespace navcal::gap::test {

/// A capture of a shipped mission's first seconds, by a vehicle with these effects (TOML) and instruments. The
/// capture says nothing of its instruments.
void write_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                   double seconds, std::uint64_t seed, const devices::InstrumentModel& instruments = {});

/// The same by a vehicle whose orders go through slew rates, twenty a second, as a daemon in between sends them.
/// Each order acts up to 8 ms after its time.
void write_shaped_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                          double seconds, std::uint64_t seed);

/// write_mission() as read back.
[[nodiscard]] Mission simulated_mission(std::string_view mission, std::string_view effects, double seconds,
                                        std::uint64_t seed, const devices::InstrumentModel& instruments = {});

}  // namespace navcal::gap::test
