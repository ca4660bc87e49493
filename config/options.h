// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/option.h"
#include "config/settings.h"

namespace navcal::config {

template <>
inline constexpr std::string_view kUntitled<PortSettings> = "port";
template <>
inline constexpr std::string_view kUntitled<PowerSettings> = "power";

/// The options outside ports, table by table in the order of the file.
[[nodiscard]] const std::vector<Option<Settings>>& daemon_options();

/// Its parts [instruments], [calibration] and [navigation].
[[nodiscard]] std::vector<Option<Settings>> instrument_options();
[[nodiscard]] std::vector<Option<Settings>> calibration_options();
[[nodiscard]] std::vector<Option<Settings>> navigation_options();

/// The options of a [port.NAME] table, those of its own first, then sub-table by sub-table.
[[nodiscard]] const std::vector<Option<PortSettings>>& port_options();

/// The table [port.NAME] of a port as a file has it, with the options of its protocol that it `states`.
[[nodiscard]] std::string port_table(const PortSettings& port, bool (*states)(const OptionInfo&, const Value&));

/// The options of a [power.NAME] table.
[[nodiscard]] const std::vector<Option<PowerSettings>>& power_options();

}  // namespace navcal::config
