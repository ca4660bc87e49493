// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// Adds the subcommands of `navcal log` that ask a running navcald: list, fetch, start, stop and select.
void add_log_control(CLI::App* log);

}  // namespace navcal::cli
