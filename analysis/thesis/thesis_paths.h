// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "calib/thesis/measured_path.h"

/// The eight paths on which the thesis (Mach 2003) tries its calibrations, as our vehicle model runs them.
namespace navcal::analysis {

inline constexpr int kThesisPaths = 8;
using ThesisPath = std::vector<calib::thesis::TruePoint>;

/// Reads a path (sim::load_path) as true motion: SI units, radians, heading unwrapped. Throws config::Error.
[[nodiscard]] ThesisPath load_thesis_path(const std::filesystem::path& file);

/// Folder with path1.csv to path8.csv, beside the program: as installed or as built. Throws Failure, which names
/// the folders, where neither has them.
[[nodiscard]] std::filesystem::path thesis_folder();

/// Reads path1.csv to path8.csv, 10 Hz. Throws config::Error where one is missing or is no path, Failure where
/// one has not 10 Hz.
[[nodiscard]] std::array<ThesisPath, kThesisPaths> load_thesis_paths(const std::filesystem::path& folder);

}  // namespace navcal::analysis
