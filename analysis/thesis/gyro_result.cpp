// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "analysis/thesis/thesis_parts.h"
#include "calib/thesis/turn_monte_carlo.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;

std::optional<double> thesis_settled_s(const std::vector<double>& time_s, const std::vector<double>& scale,
                                       const std::vector<double>& bias_rad_s) {
  std::optional<double> since;
  for (std::size_t i = 0; i < std::min(time_s.size(), scale.size()); ++i) {
    const bool close = std::abs(scale[i] / thesis::kTrueScale - 1) < kThesisSettled &&
                       std::abs(bias_rad_s[i] / thesis::kTrueBias_rad_s - 1) < kThesisSettled;
    if (!close)
      since.reset();
    else if (!since)
      since = time_s[i];
  }
  return since;
}

ThesisGyro thesis_gyro_result(const ThesisPath& path, int runs, std::uint64_t seed) {
  const Eigen::Vector2d truth(thesis::kTrueScale, thesis::kTrueBias_rad_s);
  ThesisGyro result;
  thesis::Random random(seed);
  const auto clean = thesis::measure(thesis::TurnProblem::gyro, path, thesis::kNoNoise, random);
  result.least_squares = thesis::thesis_gyro(clean);
  result.adaptive = thesis::thesis_adaptive(clean);
  result.navcal = thesis::filtered(thesis::TurnProblem::gyro, clean).estimate().head<2>();
  Eigen::Vector2d least_squares = Eigen::Vector2d::Zero(), adaptive = Eigen::Vector2d::Zero();
  for (int run = 0; run < runs; ++run) {
    const auto readings = thesis::measure(thesis::TurnProblem::gyro, path, thesis::Noise{}, random);
    least_squares += (thesis::thesis_gyro(readings) - truth).cwiseAbs2() / runs;
    adaptive += (thesis::thesis_adaptive(readings) - truth).cwiseAbs2() / runs;
  }
  result.least_squares_rms = least_squares.cwiseSqrt();
  result.adaptive_rms = adaptive.cwiseSqrt();
  const thesis::TurnStatistics ours = thesis::monte_carlo(thesis::TurnProblem::gyro, path, runs, seed);
  result.navcal_rms = ours.rms;
  result.bound = ours.bound;
  const auto settle = [&](bool noisy, std::optional<double>& adaptive_s, std::optional<double>& navcal_s) {
    const ThesisTurnTrace trace = thesis_turn_trace(path, 0, noisy, seed);
    adaptive_s = thesis_settled_s(trace.time_s, trace.adaptive_scale, trace.adaptive_bias_rad_s);
    navcal_s = thesis_settled_s(trace.time_s, trace.navcal_scale, trace.navcal_bias_rad_s);
  };
  settle(false, result.adaptive_settled_s, result.navcal_settled_s);
  settle(true, result.adaptive_noisy_settled_s, result.navcal_noisy_settled_s);
  return result;
}

}  // namespace navcal::analysis
