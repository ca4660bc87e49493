// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "config/complaints.h"
#include "runs/diagnosis.h"
#include "runs/nominal_vehicle.h"

namespace navcal::cli {
namespace {

struct ValidateRunsArguments {
  std::string nominal, runs, pools, removed, json, sessions;
};

using RunPools = std::vector<std::pair<std::string, std::vector<std::string>>>;

[[noreturn]] void bad_pools(const std::string& file, const std::string& what) {
  throw base::Failure(base::Exit::bad_input, file + ": " + what);
}

RunPools read_run_pools(const std::string& file) {
  nlohmann::ordered_json content;
  try {
    content = nlohmann::ordered_json::parse(config::content_of(file));
  } catch (const nlohmann::json::parse_error& error) {
    bad_pools(file, fmt::format("byte {}: not JSON: {}", error.byte, error.what()));
  }
  if (!content.is_object()) bad_pools(file, "not an object of pools: {\"p001\": [\"r0001\", ...]}");
  RunPools pools;
  for (const auto& [name, members] : content.items()) {
    auto& pool = pools.emplace_back(name, std::vector<std::string>{}).second;
    if (!members.is_array() || members.empty()) bad_pools(file, "pool " + name + " is not a list of runs");
    for (const auto& member : members) {
      if (!member.is_string())
        bad_pools(file, "pool " + name + ": " + member.dump() + " is not the name of a run");
      pool.push_back(member.get<std::string>());
    }
  }
  return pools;
}

const runs::EffectInformation* removed_effect(const std::string& name) {
  if (name.empty()) return nullptr;
  const auto* const effect = runs::effect_named(name);
  if (effect != nullptr) return effect;
  std::string names;
  for (const auto& known : runs::kEffects) names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
  throw base::Failure(base::Exit::usage, fmt::format("--removed {}: no such effect; there are {}", name, names));
}

/// Sessions of the nominal runs in the form of pools.
std::string sessions_json(const runs::NominalVehicle& vehicle) {
  nlohmann::ordered_json sessions = nlohmann::ordered_json::object();
  for (const auto& session : vehicle.sessions) sessions[fmt::format("s{}", sessions.size() + 1)] = session;
  return sessions.dump(2) + '\n';
}

/// Ten thousand times a run of ten seconds.
constexpr std::uintmax_t kLargestRunFile = 200'000'000;

/// All run files (.csv) of a folder and of those in it, in the order of their paths; the name of a run is that of
/// its file without the ending.
std::vector<runs::Run> read_run_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (files.empty())
    throw runs::BadRun(fmt::format("{}: {}", folder.string(), error ? error.message() : "no run files (.csv)"));
  std::ranges::sort(files);
  std::map<std::string, std::filesystem::path> named;
  std::vector<runs::Run> read;
  for (const auto& file : files) {
    if (std::filesystem::file_size(file) > kLargestRunFile)
      throw runs::BadRun(file.string() + ": too large for a run");
    const std::string name = file.stem().string();
    const auto [known, fresh] = named.emplace(name, file);
    if (!fresh) {
      throw runs::BadRun(fmt::format("{}: another run is named so: {}", file.string(), known->second.string()));
    }
    read.push_back(runs::read_run(config::content_of(file), name, file.string()));
  }
  return read;
}

nlohmann::ordered_json candidates_json(const std::vector<runs::Candidate>& candidates) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& candidate : candidates) {
    list.push_back({{"name", candidate.name}, {"probability", std::round(candidate.probability * 1e4) / 1e4}});
  }
  return list;
}

nlohmann::ordered_json deviations_json(const runs::RunDiagnosis& diagnosis) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < runs::kParameterCount; ++i) {
    if (std::isnan(diagnosis.deviations[i])) continue;
    const auto& parameter = runs::kParameters[static_cast<std::size_t>(i)];
    list.push_back({{"parameter", parameter.name},
                    {"off", diagnosis.deviations[i]},
                    {"nominal_std", diagnosis.standard_deviations[i]},
                    {"unit", parameter.unit}});
  }
  return list;
}

/// One JSON object on one line, with a line feed: what was found in a run or in a pool of runs (docs/runs.md).
/// `kind` is "run" or "pool".
std::string run_diagnosis_json(std::string_view kind, std::string_view name, const runs::RunDiagnosis& diagnosis) {
  nlohmann::ordered_json line;
  line[std::string(kind)] = name;
  line["verdict"] = runs::verdict_name(diagnosis.verdict);
  line["effects"] = candidates_json(diagnosis.effects);
  line["candidates"] = candidates_json(diagnosis.candidates);
  line["deviations"] = deviations_json(diagnosis);
  line["runs_used"] = diagnosis.runs_used;
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

/// Answers about all runs and pools, one line each.
class RunAnswers {
 public:
  RunAnswers(const runs::NominalVehicle& vehicle, const runs::EffectInformation* removed)
      : vehicle_(vehicle), removed_(removed) {}

  void add_runs(const std::vector<runs::Run>& all, const std::string& folder) {
    for (const runs::Run& run : all) {
      if (run.command_us.cols() != vehicle_.thrusters) {
        throw runs::BadRun(fmt::format("{}: run {} has {} thrusters, the nominal vehicle {}", folder, run.name,
                                       run.command_us.cols(), vehicle_.thrusters));
      }
      const auto& response = responses_.emplace(run.name, runs::response_of(run, vehicle_.clock)).first->second;
      add("run", run.name, {&response, 1});
    }
  }

  void add_pools(const RunPools& pools, const std::string& file) {
    for (const auto& [name, members] : pools) {
      std::vector<runs::Response> pool;
      for (const std::string& member : members) {
        const auto found = responses_.find(member);
        if (found == responses_.end()) bad_pools(file, fmt::format("pool {}: there is no run {}", name, member));
        pool.push_back(found->second);
      }
      add("pool", name, pool);
    }
  }

  [[nodiscard]] const std::string& lines() const { return lines_; }
  [[nodiscard]] std::string summary() const {
    std::string text;
    for (const auto& [what, count] : counts_) text += fmt::format("{:5}  {}\n", count, what);
    return text;
  }

 private:
  void add(const std::string& kind, const std::string& name, std::span<const runs::Response> responses) {
    const runs::RunDiagnosis diagnosis = runs::diagnose(vehicle_, responses, removed_);
    lines_ += run_diagnosis_json(kind, name, diagnosis);
    std::string what = fmt::format("{}: {}", kind, runs::verdict_name(diagnosis.verdict));
    for (const auto& effect : diagnosis.effects) {
      what += fmt::format("{}{}", &effect == diagnosis.effects.data() ? ", " : " or ", effect.name);
    }
    ++counts_[what];
  }

  const runs::NominalVehicle& vehicle_;
  const runs::EffectInformation* removed_;
  std::map<std::string, runs::Response> responses_;
  std::map<std::string, int> counts_;
  std::string lines_;
};

void answer_runs(const ValidateRunsArguments& arguments) {
  expect_results({arguments.nominal, arguments.runs, arguments.pools}, {arguments.json, arguments.sessions});
  const auto* const removed = removed_effect(arguments.removed);
  const RunPools pools = arguments.pools.empty() ? RunPools{} : read_run_pools(arguments.pools);
  const runs::NominalVehicle vehicle = runs::identify(read_run_folder(arguments.nominal));
  tell_remarks("navcal", vehicle.remarks);
  if (!arguments.sessions.empty()) write_result(arguments.sessions, sessions_json(vehicle));
  RunAnswers answers(vehicle, removed);
  answers.add_runs(read_run_folder(arguments.runs), arguments.runs);
  answers.add_pools(pools, arguments.pools);
  give_answer(arguments.json, answers.lines(), answers.summary());
}

void validate_runs(const ValidateRunsArguments& arguments) {
  try {
    answer_runs(arguments);
  } catch (const runs::BadNominal& error) {
    throw base::Failure(base::Exit::bad_input, arguments.nominal + ": " + error.what());
  }
}

}  // namespace

void add_validate_runs(CLI::App& app) {
  const auto [command, arguments] = add_command<ValidateRunsArguments>(
      app, "validate-runs", "causes of short runs of a thruster vehicle, from nominal runs", validate_runs);
  add_valued(command, "--nominal", "DIR", arguments->nominal)->required();
  add_valued(command, "--runs", "DIR", arguments->runs)->required();
  add_valued(command, "--pools", "FILE.json", arguments->pools);
  add_valued(command, "--removed", "NAME", arguments->removed);
  add_valued(command, "--sessions", "FILE.json", arguments->sessions);
  add_valued(command, "--json", "FILE", arguments->json)->required();
}

}  // namespace navcal::cli
