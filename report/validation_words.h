// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "validation/score.h"

namespace navcal::report {

// Words for scores and cases, shared by terminal and page.
[[nodiscard]] std::string value_text(const validation::TrialScore& score);
/// Count such as "12 of 170", or the number of values.
[[nodiscard]] std::string count_text(const validation::TrialScore& score);
[[nodiscard]] std::string interval_text(const validation::TrialScore& score);
[[nodiscard]] std::string target_text(const validation::TrialScore& score);
/// Result: "met", "missed", or empty.
[[nodiscard]] std::string met_text(const validation::TrialScore& score);
/// Summary, such as "11 of 24 targets are met, 2 could not be judged."
[[nodiscard]] std::string targets_text(const validation::TrialScores& scores);

/// The effects that are present, and the one that is removed from the library.
[[nodiscard]] std::string truth_words(const validation::TrialCase& drawn);
/// The verdict with names and probabilities, or the reason why there is none.
[[nodiscard]] std::string answer_words(const validation::TrialResult& result);

/// Whether a reader should examine the case: an effect was named that is not present, or one was left out, a null
/// was flagged, or there is no answer.
[[nodiscard]] bool is_mistake(const validation::TrialResult& result);
/// Not a mistake, but at half the typical strength or more the effect should have been named, or the case called
/// unknown.
[[nodiscard]] bool is_miss(const validation::TrialResult& result);

}  // namespace navcal::report
