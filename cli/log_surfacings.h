// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal log surfacings`.
void add_log_surfacings(CLI::App& log);

}  // namespace navcal::cli
