// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal gap watch`: judges a mission while it is sailed.
void add_gap_watch(CLI::App& gap);

}  // namespace navcal::cli
