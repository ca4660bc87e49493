// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "calib/thesis/turn_problem.h"

namespace navcal::calib::thesis {

/// Results of our filter on one path in many runs with the thesis's noise; vectors in the order of sought().
struct TurnStatistics {
  Eigen::VectorXd rms, bound;
  Eigen::VectorXd covered;  ///< share of runs with the truth within two standard errors
  CurveError curve;         ///< means of the runs' own, degrees
  double reduced_chi_squared = 0;

  /// Ratio of root-mean-square error to bound, of the worst coefficient.
  [[nodiscard]] double worst_ratio() const { return (rms.array() / bound.array()).maxCoeff(); }
};

/// The same runs for the same seed.
[[nodiscard]] TurnStatistics monte_carlo(TurnProblem problem, const std::vector<TruePoint>& path, int runs,
                                         std::uint64_t seed);

}  // namespace navcal::calib::thesis
