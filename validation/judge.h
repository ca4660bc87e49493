// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/answer.h"
#include "validation/cases.h"

namespace navcal::validation {

/// One case, asked and answered.
struct TrialResult {
  TrialCase drawn;
  Commitment seal;
  std::optional<TrialAnswer> answer;
  std::string answer_json;         ///< as it came
  std::string failure;             ///< why there is no answer
  double seconds = 0;              ///< that the diagnosing process took
  bool first_of_its_kind = false;  ///< it may have had to make null missions, too
};

enum class TrialOutcome : std::uint8_t {
  exact,  ///< all effects that are there are named, and no other
  part,   ///< only such, but not all
  /// An effect is named that is easily taken for the true one, or said to be confused with it. It counts where the
  /// true one is removed from the library, and for layouts; else it is a wrong name.
  in_class,
  wrong,  ///< something is named that is not there
  unknown,
  cannot_say,
  no_gap,
  failed,  ///< no answer
};
inline constexpr int kTrialOutcomes = 8;
[[nodiscard]] std::string_view name_of(TrialOutcome outcome);

/// A probability that was given, and whether the effect is there.
struct TrialForecast {
  double probability = 0;
  bool right = false;
};

/// A case held against its truth. What was not asked or not answered is absent.
struct TrialJudgement {
  TrialOutcome outcome = TrialOutcome::failed;
  bool right = false;                    ///< by what the arm asks for
  std::optional<bool> top_right;         ///< the most probable effect is there
  std::optional<bool> truth_considered;  ///< all that is there is named, a candidate, or said to be a twin of one
  std::optional<bool> channel_right;     ///< the strongest excess lies where one of the effects can show
  std::optional<bool> source_right;      ///< the first source is that of one of the effects
  std::optional<bool> family_right;      ///< of a foreign effect: its proposal follows such a quantity
  std::optional<double> closed;          ///< where the outcome is exact
  std::optional<bool> covered;           ///< its interval holds the true closure
  int parameters = 0, parameters_within = 0;  ///< of exact outcomes: within two standard errors of the truth
  std::vector<TrialForecast> bets;
};

/// The true closure of an exact outcome: what explains all leaves the noise of a nominal vehicle. (What the errors
/// of the parameters leave is their squares, less than the interval can resolve; in directions that the missions
/// do not show they may be large and leave nothing.)
inline constexpr double kTrueClosure = 1;

[[nodiscard]] TrialJudgement judged(const TrialResult& result);

}  // namespace navcal::validation
