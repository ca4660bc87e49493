// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "config/settings.h"

namespace navcal::config {

// Texts that are generated from the option table, so that they always agree with the program. A test compares
// the files with them; `cmake --build DIR --target config-reference` writes them anew.

/// The ports of the reference vehicle, under the names that the shipped udev rules give them.
[[nodiscard]] Settings shipped_settings();

/// config/navcald.toml: every option with unit, range, default and meaning; parse() of it gives
/// shipped_settings().
[[nodiscard]] std::string shipped_file();

/// docs/configuration.md with the part between its markers replaced by the tables of all options.
[[nodiscard]] std::string with_option_tables(std::string_view page);

}  // namespace navcal::config
