// SPDX-License-Identifier: Apache-2.0
#include "validation/active_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "base/enum_name.h"
#include "base/interruptible.h"
#include "base/temporary_folder.h"
#include "config/mission_file.h"
#include "validation/child.h"
#include "validation/missions.h"
#include "validation/recordings.h"
#include "validation/sailed_plan.h"

namespace navcal::validation {
namespace {

namespace fs = std::filesystem;

/// One case on its way, in a folder of its own.
class ActiveCase {
 public:
  ActiveCase(const TrialCase& drawn, std::uint64_t seed, const ActiveOptions& options)
      : drawn_(drawn), options_(options), dice_(seed, (13ULL << 40U) + static_cast<std::uint64_t>(drawn.number)) {
    vehicle_ = write_vehicle_file(drawn.place, folder_.path());
    const auto surveys = trial_missions(facts_of(drawn.arm).missions, options.minutes);
    first_ = sail(surveys[0], "a.cap");
    holdout_ = sail(surveys[1], "b.cap");
    survey_ = surveys[2];
  }

  ActiveAnswers run(ActiveStrategy strategy) {
    ActiveAnswers result;
    std::vector<fs::path> recordings{first_};
    try {
      result.answers.push_back(answer(recordings));
      for (int k = 1; k <= options_.missions && !base::Interruptible::interrupted(); ++k) {
        const std::string name = fmt::format("{}-{}", name_of(strategy), k);
        recordings.push_back(sail(next(strategy, recordings, name, result), name + ".cap"));
        result.answers.push_back(answer(recordings));
      }
    } catch (const std::exception& error) {
      result.failure = error.what();
    }
    return result;
  }

 private:
  fs::path sail(const reference::Mission& mission, const std::string& name) {
    reference::Mission there = at_place(mission, drawn_.place);
    there.start_ns = drawn_.place.begin_ns + day_++ * kDay_ns;
    write_recording(there, drawn_.vehicle, dice_.bits(), folder_.path() / name);
    return folder_.path() / name;
  }

  [[nodiscard]] std::vector<std::string> arguments_of(std::vector<std::string> command,
                                                      const std::vector<fs::path>& recordings) const {
    command.insert(command.end(), recordings.begin(), recordings.end());
    command.insert(command.end(), {"--holdout", holdout_, "--vehicle", vehicle_});
    if (options_.bank_missions) command.insert(command.end(), {"--bank", std::to_string(*options_.bank_missions)});
    if (!options_.cache.empty()) command.insert(command.end(), {"--cache", options_.cache});
    if (!drawn_.excluded.empty()) command.insert(command.end(), {"--exclude", drawn_.excluded});
    return command;
  }

  /// What the program writes as JSON. Throws std::runtime_error when it does not end well.
  std::string json_of(std::vector<std::string> arguments) {
    const fs::path json = folder_.path() / "answer.json", errors = folder_.path() / "errors.txt";
    fs::remove(json);
    arguments.insert(arguments.end(), {"--json", json});
    const ChildEnd end = run_child(options_.program, arguments, errors, options_.timeout);
    if (end.how != ChildEnd::How::exited || end.status != 0) {
      throw std::runtime_error("it ended with status " + std::to_string(end.status) + ": " + content_of(errors));
    }
    return content_of(json);
  }

  TrialAnswer answer(const std::vector<fs::path>& recordings) {
    return read_answer(json_of(arguments_of({"gap"}, recordings)));
  }

  reference::Mission next(ActiveStrategy strategy, const std::vector<fs::path>& recordings,
                          const std::string& name, ActiveAnswers& result) {
    const double seconds = 60.0 * options_.minutes;
    if (strategy == ActiveStrategy::random) return random_manoeuvres(seconds, dice_);
    if (strategy == ActiveStrategy::survey) return survey_;
    const fs::path mission = folder_.path() / (name + ".toml");
    auto arguments = arguments_of({"gap", "next"}, recordings);
    arguments.insert(arguments.end(), {"--minutes", std::to_string(options_.minutes), "--mission-out", mission});
    const auto plan = nlohmann::json::parse(json_of(arguments));
    result.predicted.push_back(plan.at("probability_exact"));
    return sailed_plan(config::load_mission(mission.string()), seconds);
  }

  const TrialCase& drawn_;
  const ActiveOptions& options_;
  reference::Rng dice_;
  base::TemporaryFolder folder_;
  fs::path vehicle_, first_, holdout_;
  reference::Mission survey_;
  int day_ = 0;
};

/// Counts by arm, strategy and number of missions sailed after the first one.
using ActiveCounts = std::map<std::string, std::map<ActiveStrategy, std::vector<std::map<std::string, int>>>>;

ActiveCounts counts_of(const std::vector<ActiveResult>& results) {
  ActiveCounts counts;
  for (const ActiveResult& result : results) {
    for (const auto& [strategy, answers] : result.answers) {
      auto& steps = counts[std::string(facts_of(result.drawn.arm).name)][strategy];
      for (std::size_t k = 0; k < answers.answers.size(); ++k) {
        if (steps.size() <= k) steps.emplace_back();
        ++steps[k][std::string(active_outcome(result.drawn, answers.answers[k]))];
      }
      if (answers.failure.empty()) continue;
      if (steps.size() <= answers.answers.size()) steps.emplace_back();
      ++steps[answers.answers.size()]["failed"];
    }
  }
  return counts;
}

}  // namespace

std::string_view name_of(ActiveStrategy strategy) {
  return base::enum_name<ActiveStrategy::random>(strategy, {"planned", "survey", "random"});
}

std::optional<ActiveResult> run_active(const TrialCase& drawn, const Commitment& seal, std::uint64_t seed,
                                       const ActiveOptions& options) {
  ActiveResult result{drawn, seal, {}};
  ActiveCase one(drawn, seed, options);
  for (const ActiveStrategy strategy : kActiveStrategies) {
    result.answers[strategy] = one.run(strategy);
    if (base::Interruptible::interrupted()) return std::nullopt;
  }
  return result;
}

std::string_view active_outcome(const TrialCase& drawn, const TrialAnswer& answer) {
  std::set<std::string> truth, named;
  for (const TrialEffect& effect : drawn.effects) truth.insert(effect.name);
  for (const TrialFinding& finding : answer.effects) named.insert(finding.name);
  if (named.empty()) return name_of(answer.verdict);
  if (!drawn.in_library()) return "wrong";
  if (named == truth) return "exact";
  return std::includes(truth.begin(), truth.end(), named.begin(), named.end()) ? "part" : "wrong";
}

std::string active_text(const std::vector<ActiveResult>& results) {
  std::string text = fmt::format("{:<12}{:<10}{:>9}  {}\n", "arm", "sailed", "missions", "outcomes");
  for (const auto& [arm, strategies] : counts_of(results)) {
    for (const auto& [strategy, steps] : strategies) {
      for (std::size_t k = 0; k < steps.size(); ++k) {
        if (k == 0 && strategy != ActiveStrategy::planned) continue;  // the same first recording
        std::string outcomes;
        for (const auto& [outcome, count] : steps[k]) outcomes += fmt::format("{} {}  ", outcome, count);
        text += fmt::format("{:<12}{:<10}{:>9}  {}\n", arm, k == 0 ? "-" : name_of(strategy), k, outcomes);
      }
    }
  }
  return text;
}

std::string active_json(const std::vector<ActiveResult>& results, std::uint64_t seed) {
  nlohmann::ordered_json json{{"seed", seed}, {"cases", nlohmann::ordered_json::array()}};
  for (const ActiveResult& result : results) {
    nlohmann::ordered_json one{{"case", result.drawn.number},
                               {"arm", facts_of(result.drawn.arm).name},
                               {"truth", nlohmann::ordered_json::parse(result.seal.truth)},
                               {"sha256", result.seal.digest}};
    for (const auto& [strategy, answers] : result.answers) {
      nlohmann::ordered_json outcomes = nlohmann::ordered_json::array();
      for (const TrialAnswer& answer : answers.answers) outcomes.push_back(active_outcome(result.drawn, answer));
      one[std::string(name_of(strategy))] = {
          {"outcomes", outcomes}, {"predicted", answers.predicted}, {"failure", answers.failure}};
    }
    json["cases"].push_back(std::move(one));
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace navcal::validation
