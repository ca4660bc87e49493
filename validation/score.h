// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "validation/judge.h"

namespace navcal::validation {

/// 95 % interval of a share (Wilson, J. Am. Stat. Assoc. 22, 1927); nothing known is 0 to 1.
[[nodiscard]] std::array<double, 2> wilson(int hits, int cases);
/// 0 to 1, between neighbours by proportion; absent where there are no values.
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double share);

struct TrialScore {
  std::string name;
  std::string unit;  ///< "%" for shares, whose value is 0 to 1
  std::optional<double> value;
  int hits = 0, cases = 0;                        ///< of a share; else `cases` values went in
  std::optional<std::array<double, 2>> interval;  ///< of a share
  std::optional<double> least, most;              ///< the target
  /// Least number of cases for a judgement. With fewer the 95 % interval of a share spans half of the scale and
  /// more.
  static constexpr int kLeastCasesToJudge = 10;
  /// Absent where there is no target, or too little to hold against it.
  [[nodiscard]] std::optional<bool> met() const;
};

/// Share that was named exactly, by strength.
struct TrialPower {
  double strength = 0;
  int hits = 0, cases = 0;
};

/// Probabilities given within one tenth, and the share of them that was right.
struct TrialCalibrationBin {
  int bets = 0;
  double mean_probability = 0, share_right = 0;
};
inline constexpr int kCalibrationBins = 10;

struct TrialScores {
  int cases = 0;
  std::vector<TrialScore> scores;
  std::vector<TrialPower> power;
  std::array<TrialCalibrationBin, kCalibrationBins> calibration;
  std::vector<double> closures;  ///< of exact outcomes at half the typical strength or more
  /// Counts by arm, in the order of trial_arms(), and outcome.
  std::vector<std::array<int, kTrialOutcomes>> outcomes;
};

/// Expected calibration error: mean distance of both in a bin, weighted by its bets.
[[nodiscard]] double calibration_error(std::span<const TrialCalibrationBin> bins);

/// Scores of all that was answered, each with the target that was set before any trial was run. Of layouts those
/// that no case counts for are left out.
[[nodiscard]] TrialScores trial_scores(std::span<const TrialResult> results);

}  // namespace navcal::validation
