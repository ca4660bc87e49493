// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "validation/judge.h"

namespace navcal::validation {

/// Truth against answer. A case counts once for each effect that is present: under its own name if it is named;
/// else under each wrong name, or as left out without one, or under the verdict without names.
struct TrialConfusion {
  std::vector<std::string> truths, answers;  ///< only those that occur
  std::vector<std::vector<int>> counts;      ///< by truth, then answer

  [[nodiscard]] int count(std::string_view truth, std::string_view answer) const;
};

/// Confusion over all cases except the poor missions and those at less than half the typical strength.
[[nodiscard]] TrialConfusion trial_confusion(std::span<const TrialResult> results);

}  // namespace navcal::validation
