// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal gap trial`: the check of the diagnosis on effects that are withheld from it.
void add_gap_trial(CLI::App& gap);

}  // namespace navcal::cli
