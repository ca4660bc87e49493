// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal gap next`: plans the mission that tells best what a diagnosis leaves open.
void add_gap_next(CLI::App& gap);

}  // namespace navcal::cli
