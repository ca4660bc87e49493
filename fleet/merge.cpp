// SPDX-License-Identifier: Apache-2.0
#include "fleet/merge.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "base/failure.h"
#include "fleet/whole_writing.h"
#include "gap/verdict/diagnosis.h"
#include "record/json/json_members.h"

namespace navcal::fleet {

const char* merge_tables();  // merge.sql, which the build puts into the program

namespace {

using MergedJson = nlohmann::ordered_json;

/// Binds a number, or NULL where there is none.
using Number = std::optional<double>;
using record::number_in, record::text_in, record::member_of;

std::optional<std::string> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

namespace fs = std::filesystem;

MergeSummary fill(const Plan& plan, Database& database) {
  MergeTables tables(database);
  for (const auto& [hash, file] : plan.recordings) tables.add_recording(file);
  for (const auto& [hash, toml] : plan.vehicles) tables.add_vehicle(hash, toml);
  const ResultStore results(plan.folder);
  const ResultStore::States states = results.states();
  MergeSummary summary;
  for (const Task& task : plan.tasks) {
    TaskState state = state_in(states, task);
    const std::string text = results.text_of(task, state).value_or("");
    if (text.empty()) state = TaskState::open;
    tables.add_task(task, state, text);
    (state == TaskState::done ? summary.done : state == TaskState::failed ? summary.failed : summary.open) += 1;
  }
  return summary;
}

}  // namespace

std::string words_of(const MergedJson& effect) {
  return gap::effect_words(text_in(effect, "name"), text_in(effect, "of"));
}

void make_merge_tables(Database& database) { database.execute(merge_tables()); }

MergeTables::MergeTables(Database& database)
    : recording_(database, "INSERT INTO recordings VALUES(?1, ?2, ?3)"),
      vehicle_(database, "INSERT INTO vehicles VALUES(?1, ?2)"),
      task_(database, "INSERT INTO tasks VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)"),
      gap_(database, "INSERT INTO gap VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)"),
      where_(database, "INSERT INTO gap_where VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)"),
      effect_(database, "INSERT INTO gap_effects VALUES(?1, ?2, ?3, ?4, ?5)"),
      parameter_(database, "INSERT INTO gap_parameters VALUES(?1, ?2, ?3, ?4, ?5, ?6)"),
      calibrator_(database, "INSERT INTO calibrators VALUES(?1, ?2, ?3, ?4, ?5)"),
      quantity_(database, "INSERT INTO calibration_values VALUES(?1, ?2, ?3, ?4)") {}

void MergeTables::add_recording(const RecordingFile& file) {
  recording_.run(file.recording, file.path, file.bytes);
}

void MergeTables::add_vehicle(const std::string& vehicle, const std::string& toml) { vehicle_.run(vehicle, toml); }

void MergeTables::add_task(const Task& task, TaskState state, const std::string& text) {
  const bool is_done = state == TaskState::done, is_failed = state == TaskState::failed;
  task_.run(task.number, task.job, task.recording, unless_empty(task.vehicle), unless_empty(task.configuration),
            unless_empty(task.bank), std::string(name_of(state)), is_failed ? std::optional(text) : std::nullopt,
            is_done ? std::optional(text) : std::nullopt);
  if (!is_done) return;
  try {
    const auto answer = MergedJson::parse(text);
    if (task.job == "gap") add_gap(task.number, answer);
    if (task.job == "calibrate") add_calibration(task.number, answer);
  } catch (const nlohmann::json::exception& error) {
    throw DatabaseError(fmt::format("the result of task {} is damaged: {}", task.number, error.what()));
  }
}

void MergeTables::add_gap(int task, const MergedJson& answer) {
  const MergedJson gap = member_of(answer, "gap"), interval = member_of(gap, "closed_ci"),
                   heading = member_of(gap, "heading_error_rad"),
                   reckoning = member_of(gap, "dead_reckoning_m_per_100m");
  const bool has_interval = interval.is_array() && interval.size() == 2;
  gap_.run(task, text_in(answer, "verdict"), text_in(answer, "sentence"), number_in(gap, "before"),
           number_in(gap, "after"), number_in(gap, "floor"), number_in(gap, "closed"),
           has_interval ? Number(interval[0].get<double>()) : Number(),
           has_interval ? Number(interval[1].get<double>()) : Number(), number_in(heading, "before"),
           number_in(heading, "after"), number_in(reckoning, "before"), number_in(reckoning, "after"),
           number_in(answer, "duration_s"));
  int rank = 0;
  for (const MergedJson& where : member_of(answer, "where")) {
    where_.run(task, ++rank, text_in(where, "channel"), text_in(where, "regime"), number_in(where, "gap"),
               number_in(where, "floor"), text_in(where, "unit"), number_in(where, "p_value"));
  }
  add_effects(task, "effect", member_of(answer, "effects"));
  add_effects(task, "candidate", member_of(answer, "candidates"));
}

void MergeTables::add_effects(int task, const char* role, const MergedJson& effects) {
  int rank = 0;
  for (const MergedJson& effect : effects) {
    const std::string name = words_of(effect);
    effect_.run(task, role, ++rank, name, number_in(effect, "probability"));
    const MergedJson values = member_of(effect, "parameters"), errors = member_of(effect, "std_errors");
    for (const auto& [parameter, value] : values.items()) {
      parameter_.run(task, role, name, parameter, number_in(values, parameter.c_str()),
                     number_in(errors, parameter.c_str()));
    }
  }
}

void MergeTables::add_calibration(int task, const MergedJson& answer) {
  for (const auto& [calibrator, values] : answer.items()) {
    if (!values.is_object()) continue;
    const MergedJson accepted = member_of(values, "accepted");
    calibrator_.run(task, calibrator, accepted.is_boolean() ? Number(accepted.get<bool>() ? 1 : 0) : Number(),
                    text_in(values, "judgement"), text_in(values, "reason"));
    add_quantities(task, calibrator, values);
  }
}

void MergeTables::add_quantities(int task, const std::string& calibrator, const MergedJson& values) {
  const MergedJson flat = values.flatten();
  for (const auto& [path, value] : flat.items()) {
    // "/deviation_deg/A" becomes "deviation_deg.A".
    std::string quantity = path.substr(1);
    for (char& c : quantity) c = c == '/' ? '.' : c;
    if (value.is_number()) quantity_.run(task, calibrator, quantity, value.get<double>());
  }
}

MergeSummary merge(const Plan& plan, const fs::path& file) {
  const fs::path part = part_of(file);
  try {
    fs::remove(part);
    MergeSummary summary;
    {
      Database database(part, Database::Access::create);
      make_merge_tables(database);
      database.execute("BEGIN");
      summary = fill(plan, database);
      database.execute("COMMIT");
    }
    rename_whole(part, file);
    return summary;
  } catch (const DatabaseError& error) {
    fs::remove(part);
    throw base::Failure(base::Exit::failed, error.what());
  } catch (...) {
    fs::remove(part);
    throw;
  }
}

}  // namespace navcal::fleet
