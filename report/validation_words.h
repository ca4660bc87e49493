// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "validation/score.h"

namespace navcal::report {

// What is said of a score and of a case, on the terminal and on the page alike.
[[nodiscard]] std::string value_text(const validation::TrialScore& score);
/// "12 of 170", or the number of values.
[[nodiscard]] std::string count_text(const validation::TrialScore& score);
[[nodiscard]] std::string interval_text(const validation::TrialScore& score);
[[nodiscard]] std::string target_text(const validation::TrialScore& score);
/// "met", "missed", or empty.
[[nodiscard]] std::string met_text(const validation::TrialScore& score);
/// "11 of 24 targets are met, 2 could not be tried."
[[nodiscard]] std::string targets_text(const validation::TrialScores& scores);

/// The effects that are there, with what the library is without.
[[nodiscard]] std::string truth_words(const validation::TrialCase& drawn);
/// The verdict, with names and probabilities; why there is none.
[[nodiscard]] std::string answer_words(const validation::TrialResult& result);

/// Whether a reader should look into the case: something was named that is not there or left out, a null was
/// flagged, or there is no answer.
[[nodiscard]] bool is_mistake(const validation::TrialResult& result);
/// Not a mistake, but at half the typical strength or more it should have been named, or called unknown.
[[nodiscard]] bool is_miss(const validation::TrialResult& result);

}  // namespace navcal::report
