// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/turn_monte_carlo.h"

#include <cmath>

namespace navcal::calib::thesis {

TurnStatistics monte_carlo(TurnProblem problem, const std::vector<TruePoint>& path, int runs, std::uint64_t seed) {
  const Noise noise;
  const std::vector<int> coefficients = sought(problem);
  const TurnCoefficients truth = true_coefficients(problem);
  Random random(seed);
  TurnStatistics statistics;
  statistics.bound = cramer_rao(problem, path, noise);
  statistics.rms = statistics.covered = Eigen::VectorXd::Zero(statistics.bound.size());
  for (int run = 0; run < runs; ++run) {
    const TurnFilter filter = filtered(problem, measure(problem, path, noise, random));
    const TurnCoefficients error = filter.estimate() - truth;
    const TurnCovariance covariance = filter.covariance();
    for (Eigen::Index i = 0; i < statistics.rms.size(); ++i) {
      const int c = coefficients[static_cast<std::size_t>(i)];
      statistics.rms[i] += error[c] * error[c] / runs;
      if (std::abs(error[c]) < 2 * std::sqrt(covariance(c, c))) statistics.covered[i] += 1.0 / runs;
    }
    const CurveError curve = curve_error(error.tail<4>());
    statistics.curve.largest_deg += curve.largest_deg / runs;
    statistics.curve.deviation_deg += curve.deviation_deg / runs;
    statistics.reduced_chi_squared += filter.reduced_chi_squared() / runs;
  }
  statistics.rms = statistics.rms.cwiseSqrt();
  return statistics;
}

}  // namespace navcal::calib::thesis
