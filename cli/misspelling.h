// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace navcal::cli {

/// Message for a command line with a command or an option that does not exist: its name and the nearest one
/// that does. Empty when neither is the cause of the error.
[[nodiscard]] std::string misspelling(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace navcal::cli
