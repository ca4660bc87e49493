// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// Adds `navcal log import`.
void add_log_import(CLI::App& log);

}  // namespace navcal::cli
