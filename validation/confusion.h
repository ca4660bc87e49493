// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "validation/judge.h"

namespace navcal::validation {

/// What was there against what was answered. A case counts once for each effect that is there: where it is named,
/// as itself; else as each wrong name, or as left out where there is none, or as the verdict without names.
struct TrialConfusion {
  std::vector<std::string> truths, answers;  ///< only those that occur
  std::vector<std::vector<int>> counts;      ///< by truth, then answer

  [[nodiscard]] int count(std::string_view truth, std::string_view answer) const;
};

/// Of all cases but those at less than half the typical strength and the poor missions.
[[nodiscard]] TrialConfusion trial_confusion(std::span<const TrialResult> results);

}  // namespace navcal::validation
