// SPDX-License-Identifier: Apache-2.0
#include "fleet/task_run.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "config/load.h"
#include "config/vehicle_file.h"
#include "fleet/catalogue.h"
#include "fleet/jobs.h"
#include "fleet/whole_writing.h"
#include "record/content_hash.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

/// No result, for a reason that lies outside of the recording.
class NotNow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The file of the recording, which must have the content that was planned.
fs::path recording_of(const Plan& plan, const Task& task) {
  const auto found = plan.recordings.find(task.recording);
  if (found == plan.recordings.end()) throw NotNow("the recording is gone");
  const RecordingFile& planned = found->second;
  RecordingFile now = planned;
  if (!look_at(now)) throw NotNow(planned.path + ": the file is gone; make the plan once more");
  const bool is_unchanged = now.bytes == planned.bytes && now.modified_ns == planned.modified_ns;
  if (!is_unchanged && record::sha256_of_file(planned.path) != task.recording) {
    throw NotNow(planned.path + ": it has changed since it was planned; make the plan once more");
  }
  return planned.path;
}

/// Folder of the null bank that a task uses; empty: it has none, or none can be made of that mission.
fs::path bank_used(const Plan& plan, const Task& task) {
  if (task.bank.empty()) return {};
  const Task* const maker = plan.maker_of(task.bank);
  if (maker == nullptr) throw NotNow("the plan has no task that makes the null bank " + task.bank);
  switch (ResultStore(plan.folder).state_of(*maker)) {
    case TaskState::done: return plan.bank_folder(task.bank);
    case TaskState::failed: return {};
    default: throw NotNow(fmt::format("its null bank is not made yet (task {})", maker->number));
  }
}

std::string answer_of(const Plan& plan, const Task& task, unsigned threads) {
  JobInput input;
  input.recording = recording_of(plan, task);
  if (!task.vehicle.empty()) input.vehicle = config::parse_vehicle(plan.vehicles.at(task.vehicle), "vehicle");
  if (!task.configuration.empty()) {
    input.settings = config::parse(plan.configurations.at(task.configuration), "configuration");
  }
  input.bank_missions = task.bank_missions;
  input.bank_seed = task.bank_seed;
  input.threads = threads;
  if (!task.makes_bank()) {
    input.bank_folder = bank_used(plan, task);
    return job_named(task.job).answer(input);
  }
  const fs::path folder = plan.bank_folder(task.bank);
  fs::create_directories(folder.parent_path());
  input.bank_folder = part_of(folder);
  fs::remove_all(input.bank_folder);
  try {
    std::string answer = bank_job().answer(input);
    rename_whole(input.bank_folder, folder);
    return answer;
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(input.bank_folder, ignored);
    throw;
  }
}

}  // namespace

Attempt run_task(const Plan& plan, const Task& task, unsigned threads) {
  const ResultStore results(plan.folder);
  if (const TaskState before = results.state_of(task); before != TaskState::open) {
    return {before, before == TaskState::failed ? results.text_of(task, before).value_or("") : std::string()};
  }
  std::string error;
  try {
    results.keep_answer(task, answer_of(plan, task, threads));
    return {TaskState::done, {}};
  } catch (const NotNow& reason) {
    return {TaskState::open, reason.what()};
  } catch (const std::system_error& reason) {
    return {TaskState::open, reason.what()};
  } catch (const std::bad_alloc&) {
    return {TaskState::open, "out of memory"};
  } catch (const std::exception& reason) {
    error = reason.what();
  }
  try {
    results.keep_error(task, error);
    return {TaskState::failed, error};
  } catch (const std::system_error& reason) {
    return {TaskState::open, reason.what()};
  }
}

}  // namespace navcal::fleet
