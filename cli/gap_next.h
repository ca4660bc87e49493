// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// Adds `navcal gap next`.
void add_gap_next(CLI::App& gap);

}  // namespace navcal::cli
