// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "runs/run.h"

namespace navcal::analysis {

/// Reads all run files (.csv) of a folder and of those in it, in the order of their paths; the name of a run is
/// that of its file without the ending. Throws runs::BadRun for a file that cannot be used, for two of one name,
/// and for a folder without run files; std::system_error for one that cannot be read.
[[nodiscard]] std::vector<runs::Run> read_run_folder(const std::filesystem::path& folder);

}  // namespace navcal::analysis
