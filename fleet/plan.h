// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"

namespace navcal::fleet {

/// One line of a plan: something that is done with one recording. Recordings, vehicles and configurations are
/// named by the SHA-256 of their content.
struct Task {
  int number = 0;   ///< from 1 on; stays when a plan is made anew
  std::string job;  ///< `gap`, `calibrate` ..., or `bank` for a null bank
  std::string recording;
  std::string vehicle;        ///< a layout with its nominal recordings; empty: the job does not use it
  std::string configuration;  ///< empty: the recording's own
  std::string bank;           ///< key of the null bank that it makes or uses; empty: none
  int bank_missions = 0;
  std::uint64_t bank_seed = 0;
  std::string key;  ///< name of the result: the hash of all above but the number, and of the program's version

  [[nodiscard]] bool makes_bank() const;
};

/// A file that holds a recording, as it was when the plan was made.
struct RecordingFile {
  std::string path;  ///< absolute
  std::int64_t bytes = 0;
  std::int64_t modified_ns = 0;  ///< time of the last modification, UNIX
  std::string recording;
};

/// A plan: PLAN/plan.sqlite in memory. docs/fleet.md has the tables.
struct Plan {
  std::filesystem::path folder;                     ///< absolute
  std::vector<Task> tasks;                          ///< in order of their numbers, which may have gaps
  std::map<std::string, RecordingFile> recordings;  ///< the file of each recording, by its hash; the first by path
  std::map<std::string, std::string> vehicles;      ///< TOML by its hash
  std::map<std::string, std::vector<std::string>> nominals;  ///< recordings without a gap, by the vehicle's hash
  std::map<std::string, std::string> configurations;         ///< TOML by its hash

  [[nodiscard]] const Task* task(int number) const;
  /// The task that makes this bank; null: none does.
  [[nodiscard]] const Task* maker_of(std::string_view bank) const;
  [[nodiscard]] std::filesystem::path bank_folder(std::string_view bank) const;
  /// A short name of the plan, by its place.
  [[nodiscard]] std::string id() const;
};

/// Name of the catalogue in a plan's folder.
[[nodiscard]] std::filesystem::path catalogue_of(const std::filesystem::path& plan);

/// Reads a plan. Throws base::Failure (bad input) when the folder is none, or was made by another format.
[[nodiscard]] Plan load_plan(const std::filesystem::path& folder);

/// The tasks that a text names: "3", "3,7,9", "10-20". Throws base::Failure (usage).
[[nodiscard]] std::vector<const Task*> tasks_named(const Plan& plan, std::string_view text);

/// Held by whoever extends a plan or submits its tasks: two of them would do the same work twice. Gone with its
/// process.
class PlanLock {
 public:
  /// Throws base::Failure when another process holds it, std::system_error when the file cannot be made.
  explicit PlanLock(const std::filesystem::path& plan);

 private:
  base::Descriptor file_;
};

}  // namespace navcal::fleet
