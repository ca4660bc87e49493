// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"

namespace navcal::config {

/// Parts of the log that can be left out. Configuration, time mappings, events and the calibration with which a
/// file begins are always there: without them the rest cannot be understood.
enum class LogGroup : std::uint8_t { samples, navigation, health, calibration, commands, raw };

inline constexpr std::array<std::string_view, 6> kLogGroups{"samples",     "navigation", "health",
                                                            "calibration", "commands",   "raw"};
/// So that the report of what is left out stays one short line.
inline constexpr std::size_t kMostChoices = 64;
/// Before the name of a port: its raw bytes alone.
inline constexpr std::string_view kRawChoice = "raw.";

/// One of kLogGroups, or "raw.NAME" with the name of a port that may exist.
[[nodiscard]] bool is_log_choice(std::string_view text);

/// Why these cannot be left out of a log of these ports; nullopt: they can. Shared by [log] leave_out and
/// log.select.
[[nodiscard]] std::optional<std::string> problem_with_choice(const std::vector<std::string>& leave_out,
                                                             const std::vector<PortSettings>& ports);

}  // namespace navcal::config
