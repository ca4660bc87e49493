// SPDX-License-Identifier: Apache-2.0
#include "validation/run.h"

#include <fmt/format.h>
#include <string.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include "base/interruptible.h"
#include "base/temporary_folder.h"
#include "validation/child.h"
#include "validation/recordings.h"

namespace navcal::validation {
namespace {

namespace fs = std::filesystem;

/// The last line that says something; usually it says why.
std::string last_line(std::string text) {
  text.erase(text.find_last_not_of(" \r\n\t") + 1);
  return text.substr(text.find_last_of("\r\n") + 1);
}

/// Empty when it ended as it should.
std::string complaint_about(const ChildEnd& end, const std::string& errors, std::chrono::seconds timeout) {
  const std::string said = last_line(errors);
  const std::string and_said = said.empty() ? std::string() : ": " + said;
  switch (end.how) {
    case ChildEnd::How::signalled:
      return fmt::format("it was ended by signal {} ({}){}", end.status, ::strsignal(end.status), and_said);
    case ChildEnd::How::timed_out: return fmt::format("no answer within {} s{}", timeout.count(), and_said);
    default:
      return end.status == 0 ? std::string() : fmt::format("it ended with status {}{}", end.status, and_said);
  }
}

/// Runs the program under trial, which writes its complaints into the folder. Empty when it ended as it should.
std::string run_program(const CaseRunOptions& asking, const std::vector<std::string>& arguments,
                        const fs::path& folder, double& seconds) {
  const ChildEnd end = run_child(asking.program, arguments, folder / "errors.txt", asking.timeout);
  seconds = end.seconds;
  return complaint_about(end, content_of(folder / "errors.txt"), asking.timeout);
}

void keep(const fs::path& folder, const CaseRunOptions& asking, const std::string& name) {
  if (asking.keep.empty()) return;
  fs::create_directories(asking.keep / name);
  fs::copy(folder, asking.keep / name, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

/// A vehicle, as options of `navcal gap`; the first is the file of --vehicle.
struct VehicleUnderTrial {
  std::vector<std::string> options;
  std::string failure;  ///< why it could not be identified
};

/// Makes the nominal recordings of a vehicle with a layout, and has it identified from them.
VehicleUnderTrial identified(const LayoutVehicle& vehicle, const CaseRunOptions& asking, const fs::path& folder) {
  VehicleUnderTrial made{{folder / "vehicle.toml", "--config", folder / "navcald.toml"}, {}};
  try {
    fs::create_directories(folder);
    std::vector<std::string> arguments{"identify", "--no-advice"};
    for (const std::string& file : write_vehicle(vehicle, folder)) {
      arguments.push_back(file);
      made.options.insert(made.options.end(), {"--nominal", file});
    }
    arguments.insert(arguments.end(), {"--config", folder / "navcald.toml", "--vehicle", folder / "sheet.toml",
                                       "-o", folder / "vehicle.toml"});
    double seconds = 0;
    made.failure = run_program(asking, arguments, folder, seconds);
    if (!made.failure.empty()) made.failure = "the vehicle is not identified: " + made.failure;
    keep(folder, asking, folder.filename());
  } catch (const std::exception& error) {
    made.failure = error.what();
  }
  return made;
}

void diagnose(const TrialCase& drawn, const CaseRunOptions& asking, const VehicleUnderTrial& vehicle,
              const fs::path& folder, TrialResult& result) {
  const auto files = write_recordings(drawn, folder);
  result.failure = vehicle.failure;
  if (!result.failure.empty()) return;
  const fs::path json = folder / "answer.json";
  std::vector<std::string> arguments{"gap", files[0], "--holdout", files[1], "--holdout", files[2], "--vehicle"};
  arguments.insert(arguments.end(), vehicle.options.begin(), vehicle.options.end());
  if (drawn.on_layout == nullptr) arguments.push_back(write_vehicle_file(drawn.place, folder));
  arguments.insert(arguments.end(), {"--json", json});
  if (asking.bank_missions) arguments.insert(arguments.end(), {"--bank", std::to_string(*asking.bank_missions)});
  for (const std::string& name : asking.without) arguments.insert(arguments.end(), {"--without", name});
  if (!drawn.excluded.empty()) arguments.insert(arguments.end(), {"--exclude", drawn.excluded});
  result.failure = run_program(asking, arguments, folder, result.seconds);
  if (!result.failure.empty()) return;
  result.answer_json = content_of(json);
  if (result.answer_json.empty()) throw std::runtime_error("it ended well, but wrote no answer");
  result.answer = read_answer(result.answer_json);
}

/// Writes the recordings of a case into a fresh folder, has them diagnosed by a process that is told their names
/// and no more, and reads its answer. Absent when it was interrupted.
std::optional<TrialResult> ask(const TrialCase& drawn, const Commitment& seal, const CaseRunOptions& asking,
                               const VehicleUnderTrial& vehicle) {
  TrialResult result{drawn, seal, {}, {}, {}, 0, false};
  const base::TemporaryFolder folder;
  try {
    diagnose(drawn, asking, vehicle, folder.path(), result);
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  if (base::Interruptible::interrupted()) return std::nullopt;
  keep(folder.path(), asking, fmt::format("{:04}", drawn.number));
  return result;
}

class CaseQueue {
 public:
  CaseQueue(const std::vector<TrialCase>& cases, const std::vector<Commitment>& seals,
            const CaseRunOptions& asking, const std::function<void(const TrialResult&)>& answered)
      : cases_(cases), seals_(seals), asking_(asking), answered_(answered) {}

  void ask_one(std::size_t i, bool first_of_its_kind) {
    try {
      auto result = ask(cases_[i], seals_[i], asking_, vehicle_of(cases_[i]));
      const std::lock_guard lock(mutex_);
      if (!result) return;
      result->first_of_its_kind = first_of_its_kind && cases_[i].on_layout == nullptr;
      answered_(*result);
      run_.results.push_back(std::move(*result));
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      run_.ended_early = error.what();
    }
  }

  void ask_in_parallel(const std::vector<std::size_t>& those) {
    std::atomic<std::size_t> next{0};
    std::vector<std::jthread> workers;
    for (unsigned job = 0; job < asking_.jobs; ++job) {
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < those.size() && !ends_early(); i = next++) ask_one(those[i], false);
      });
    }
  }

  [[nodiscard]] bool ends_early() {
    const std::lock_guard lock(mutex_);
    if (base::Interruptible::interrupted()) run_.ended_early = "interrupted";
    return !run_.ended_early.empty();
  }

  [[nodiscard]] TrialRun finish() {
    (void)ends_early();
    std::ranges::sort(run_.results, [](const auto& a, const auto& b) { return a.drawn.number < b.drawn.number; });
    return std::move(run_);
  }

 private:
  /// The first case of a vehicle, which is asked alone, has it identified.
  const VehicleUnderTrial& vehicle_of(const TrialCase& drawn) {
    const auto [vehicle, is_new] = vehicles_.try_emplace(drawn.on_layout == nullptr ? 0 : drawn.place_number);
    if (is_new && drawn.on_layout != nullptr) {
      vehicle->second = identified(*drawn.on_layout->vehicle, asking_,
                                   folder_.path() / fmt::format("vehicle-{}", drawn.place_number));
    }
    return vehicle->second;
  }

  const std::vector<TrialCase>& cases_;
  const std::vector<Commitment>& seals_;
  const CaseRunOptions& asking_;
  const std::function<void(const TrialResult&)>& answered_;
  std::mutex mutex_;
  TrialRun run_;
  base::TemporaryFolder folder_;  ///< of the vehicles with a layout
  std::map<int, VehicleUnderTrial> vehicles_;
};

}  // namespace

TrialRun ask_all(const std::vector<TrialCase>& cases, const std::vector<Commitment>& seals,
                 const CaseRunOptions& asking, const std::function<void(const TrialResult&)>& answered) {
  CaseQueue all(cases, seals, asking, answered);
  std::set<std::tuple<MissionKind, double, int>> begun;
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < cases.size() && !all.ends_early(); ++i) {
    if (begun.emplace(facts_of(cases[i].arm).missions, cases[i].minutes, cases[i].place_number).second)
      all.ask_one(i, true);
    else
      rest.push_back(i);
  }
  all.ask_in_parallel(rest);
  return all.finish();
}

}  // namespace navcal::validation
