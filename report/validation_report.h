// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/confusion.h"
#include "validation/score.h"

namespace navcal::report {

/// A trial after its last answer: from here on the truth may be told.
struct TrialReport {
  std::uint64_t seed = 0;
  int minutes = 10;
  int places = validation::kTrialPlaces;
  std::size_t asked_for = 0;  ///< cases
  std::string ended_early;    ///< why
  std::vector<validation::TrialResult> results;
  validation::TrialScores scores;
  validation::TrialConfusion confusion;
};

/// For a terminal.
[[nodiscard]] std::string trial_text(const TrialReport& report);
/// Everything, with truths, salts and answers, as one JSON object.
[[nodiscard]] std::string trial_json(const TrialReport& report);
/// One page that needs no other file.
[[nodiscard]] std::string trial_page(const TrialReport& report);

/// How a case is asked again by itself.
[[nodiscard]] std::string rerun_command(const TrialReport& report, int number);

}  // namespace navcal::report
