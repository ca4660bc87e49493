// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace navcal::cli {

/// What to tell somebody whose command line could not be parsed because of a command or an option that does not
/// exist: its name, and the nearest one that does. Empty when neither is the reason.
[[nodiscard]] std::string misspelling(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace navcal::cli
