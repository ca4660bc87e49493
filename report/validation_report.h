// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/confusion.h"
#include "validation/layout_cases.h"
#include "validation/score.h"

namespace navcal::report {

/// A trial after its last answer, when the truth may be published.
struct TrialReport {
  std::uint64_t seed = 0;
  double minutes = 10;
  int places = validation::kTrialPlaces;
  std::size_t asked_for = 0;  ///< number of cases
  std::string ended_early;    ///< reason; empty if it ran to the end
  std::vector<validation::TrialResult> results;
  validation::TrialScores scores;
  validation::TrialConfusion confusion;
  validation::LayoutTrial on_layouts;  ///< without layouts: of the reference vehicle
};

/// The trial as text for a terminal.
[[nodiscard]] std::string trial_text(const TrialReport& report);
/// All cases with truths, salts and answers, as one JSON object.
[[nodiscard]] std::string trial_json(const TrialReport& report);
/// One self-contained page.
[[nodiscard]] std::string trial_page(const TrialReport& report);

/// "seed 7, missions of 10 minutes, 12 places".
[[nodiscard]] std::string trial_words(const TrialReport& report);
/// Command that repeats a single case.
[[nodiscard]] std::string rerun_command(const TrialReport& report);

}  // namespace navcal::report
