// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace navcal::cli {

/// `navcal gap next`: plans the mission that tells best what a diagnosis leaves open. `usual_cache`: folder of
/// null banks without --cache.
void add_gap_next(CLI::App& gap, const std::filesystem::path& usual_cache);

}  // namespace navcal::cli
