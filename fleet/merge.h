// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "fleet/database.h"
#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

/// Makes the tables of merged results (docs/fleet.md).
void make_merge_tables(Database& database);

/// Fills them. All throw DatabaseError.
class MergeTables {
 public:
  explicit MergeTables(Database& database);

  void add_recording(const RecordingFile& file);
  void add_vehicle(const std::string& vehicle, const std::string& toml);
  /// A task with its answer, its error or, while it is open, nothing. An answer goes into the tables of its job,
  /// too.
  void add_task(const Task& task, TaskState state, const std::string& text);

 private:
  void add_gap(int task, const nlohmann::ordered_json& answer);
  void add_effects(int task, const char* role, const nlohmann::ordered_json& effects);
  void add_calibration(int task, const nlohmann::ordered_json& answer);
  void add_quantities(int task, const std::string& calibrator, const nlohmann::ordered_json& values);

  Statement recording_, vehicle_, task_, gap_, where_, effect_, parameter_, calibrator_, quantity_;
};

/// An effect of an answer in words (gap::effect_words).
[[nodiscard]] std::string words_of(const nlohmann::ordered_json& effect);

struct MergeSummary {
  std::size_t done = 0, failed = 0, open = 0;
};

/// Writes all results of a plan into one SQLite file; docs/fleet.md has its tables. The same plan and results give
/// the same bytes, in whatever order and wherever the tasks were done. Throws base::Failure,
/// std::system_error.
[[nodiscard]] MergeSummary merge(const Plan& plan, const std::filesystem::path& file);

}  // namespace navcal::fleet
