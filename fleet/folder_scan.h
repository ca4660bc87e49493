// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "fleet/plan.h"

namespace navcal::fleet {

/// Recordings (.cap, .mcap) and vehicles (vehicle.toml) below a folder. Hidden folders, links to folders, and
/// folders of plans are passed over.
struct FolderScan {
  std::vector<RecordingFile> files;                                 ///< by path; without their hashes
  std::map<std::filesystem::path, std::filesystem::path> vehicles;  ///< vehicle.toml by the folder that it is in

  /// The vehicle.toml of the file's folder or of the nearest one above it, within the scan; empty: there is none.
  [[nodiscard]] std::filesystem::path vehicle_of(const std::filesystem::path& file) const;
};

/// Throws analysis::Failure (bad input) when the folder cannot be read.
[[nodiscard]] FolderScan scan(const std::filesystem::path& folder);

/// Size and time of modification of a file now; false where there is none.
[[nodiscard]] bool look_at(RecordingFile& file);

}  // namespace navcal::fleet
