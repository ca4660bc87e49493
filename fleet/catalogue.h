// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fleet/database.h"
#include "fleet/plan.h"
#include "gap/nulls/mission_outline.h"

// The tables of PLAN/plan.sqlite; docs/fleet.md says what each column means.
namespace navcal::fleet {

/// A null bank of a plan, and the mission that it is made of.
struct PlannedBank {
  std::string bank;  ///< key
  std::string recording, vehicle, configuration;
  int missions = 0;
  std::uint64_t seed = 0;
  gap::MissionOutline outline;
};

/// Makes the tables where they are missing. Throws Failure (bad input) for those of another format.
void make_catalogue(Database& database, const std::string& name);

/// Reads all but the folder and the banks. Tasks whose recording is gone are left out. Throws as make_catalogue().
void read_catalogue(Database& database, const std::string& name, Plan& plan);

[[nodiscard]] std::vector<RecordingFile> read_files(Database& database);
[[nodiscard]] std::vector<PlannedBank> read_banks(Database& database);
/// All tasks, those included whose recording is gone.
[[nodiscard]] std::vector<Task> read_tasks(Database& database);

/// Replaces the files.
void write_files(Database& database, const std::vector<RecordingFile>& files);
void add_bank(Database& database, const PlannedBank& bank);
void add_task(Database& database, const Task& task);

/// Recordings (.cap, .mcap) and vehicles (vehicle.toml) below a folder. Hidden folders, links to folders, and
/// folders of plans are passed over.
struct FolderScan {
  std::vector<RecordingFile> files;                                 ///< by path; without their hashes
  std::map<std::filesystem::path, std::filesystem::path> vehicles;  ///< vehicle.toml by the folder that it is in

  /// The vehicle.toml of the file's folder or of the nearest one above it, within the scan; empty: there is none.
  [[nodiscard]] std::filesystem::path vehicle_of(const std::filesystem::path& file) const;
};

/// Throws base::Failure (bad input) when the folder cannot be read.
[[nodiscard]] FolderScan scan(const std::filesystem::path& folder);

/// Size and time of modification of a file now; false where there is none.
[[nodiscard]] bool look_at(RecordingFile& file);

}  // namespace navcal::fleet
