// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/answer.h"
#include "validation/layout_cases.h"
#include "validation/score.h"

namespace navcal::validation {

/// What is true of one case, as the truth file has it.
struct LayoutTruth {
  struct Present {
    std::string name, of, of_name;  ///< "thrust_scale", "thruster.2", "front_port"
    std::map<std::string, double, std::less<>> parameters;
  };
  std::string number;  ///< "0001"
  LayoutArm arm = LayoutArm::nulls;
  std::string excluded;
  std::vector<Present> effects;
};

enum class LayoutOutcome : std::uint8_t {
  exact,       ///< all effects that are there are named, at the right place, and no other
  part,        ///< only such, but not all
  in_class,    ///< what is named is there, or easily taken for what is there; or it is said to be confused with it
  wrong,       ///< something else is named
  unknown,     ///< a gap of no known cause
  cannot_say,  ///< the answer says that the recording does not show it
  no_gap,
  failed,  ///< no answer
};
inline constexpr int kLayoutOutcomes = 8;
[[nodiscard]] std::string_view name_of(LayoutOutcome outcome);

/// One line of answers. The line holds what `navcal gap --json` prints, with the case's number:
///     {"case":"0001","verdict":"explained","effects":[{"name":"thrust_scale","of":"thruster.2","probability":0.99,...
/// The verdict "cannot-say" stands beside those of TrialVerdict; {"case":"0001","failure":"..."} is no answer.
struct LayoutAnswer {
  std::string number;
  bool cannot_say = false;
  std::optional<TrialAnswer> answer;
};

/// Cases of a truth file, in its order; lines about vehicles are left out. Both throw std::runtime_error, which
/// names the line.
[[nodiscard]] std::vector<LayoutTruth> read_layout_truths(std::string_view lines);
[[nodiscard]] std::vector<LayoutAnswer> read_layout_answers(std::string_view lines);

[[nodiscard]] LayoutOutcome outcome_of(const LayoutTruth& truth, const LayoutAnswer& answer);
/// Whether one effect is easily taken for another: of the same thruster; of the same axis; both of weight,
/// buoyancy and balance; drag against thrust; of instruments the confounders of confounded_effects.h.
[[nodiscard]] bool is_confounded(const LayoutTruth::Present& present, std::string_view full_name);

struct LayoutScores {
  int cases = 0, answered = 0;
  std::vector<TrialScore> scores;
  /// Counts by arm and outcome.
  std::array<std::array<int, kLayoutOutcomes>, kLayoutArms> outcomes{};
};

/// Scores with the targets of the other validation (score.h). A case without an answer counts as failed; an answer
/// to no case is an error (std::runtime_error), and so are two to one.
[[nodiscard]] LayoutScores layout_scores(const std::vector<LayoutTruth>& truths,
                                         const std::vector<LayoutAnswer>& answers);

}  // namespace navcal::validation
