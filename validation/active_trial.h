// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/answer.h"
#include "validation/cases.h"

namespace navcal::validation {

/// What the vehicle sails after the first recording.
enum class ActiveStrategy : std::uint8_t {
  planned,  ///< what navcal gap next plans
  survey,   ///< as many minutes more of an ordinary survey
  random,   ///< as many minutes of random manoeuvres
};
inline constexpr std::array kActiveStrategies{ActiveStrategy::planned, ActiveStrategy::survey,
                                              ActiveStrategy::random};
/// "planned", "survey", "random".
[[nodiscard]] std::string_view name_of(ActiveStrategy strategy);

inline constexpr int kMostPlannedMissions = 3;

struct ActiveOptions {
  std::filesystem::path program;  ///< navcal
  int missions = 1;               ///< sailed after the first one, at most kMostPlannedMissions
  int minutes = 3;                ///< of each mission
  std::optional<int> bank_missions;
  std::chrono::seconds timeout{600};
  std::filesystem::path cache;  ///< of null banks; shared by all cases
};

/// Answers of one strategy: after the first recording, and after each mission more.
struct ActiveAnswers {
  std::vector<TrialAnswer> answers;
  std::vector<double> predicted;  ///< probability of an exact answer that each plan states
  std::string failure;            ///< why it ended early; empty: it did not
};

struct ActiveResult {
  TrialCase drawn;
  Commitment seal;
  std::map<ActiveStrategy, ActiveAnswers> answers;
};

/// Runs one case: the reference vehicle sails a short survey and a hold-out. The program under test answers,
/// plans, and answers again with all recordings so far; for the other strategies it only answers. Empty when it
/// was interrupted.
[[nodiscard]] std::optional<ActiveResult> run_active(const TrialCase& drawn, const Commitment& seal,
                                                     std::uint64_t seed, const ActiveOptions& options);

/// "exact", "part", "wrong", "unknown", "no-gap", "failed": an answer against the truth.
[[nodiscard]] std::string_view active_outcome(const TrialCase& drawn, const TrialAnswer& answer);

/// Counts of outcomes by arm, strategy and number of missions sailed, for people and as JSON.
[[nodiscard]] std::string active_text(const std::vector<ActiveResult>& results);
[[nodiscard]] std::string active_json(const std::vector<ActiveResult>& results, std::uint64_t seed);

}  // namespace navcal::validation
