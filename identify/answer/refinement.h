// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/parameters.h"

namespace navcal::identify {

struct Refinement {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< inverse of the information, in the parameters' units
  /// Errors of predictions, after over before: geometric mean over the horizons, with what the fit's freedom
  /// hides.
  double error_ratio = 1;
};

/// Parameters by least squares of open-loop predictions in the recordings, with the priors: north, east and
/// heading after 2, 5, 10, 20, 40 and 60 s, from starts every 2 s, each over the root mean square of `start` at
/// that horizon. Predictions that overlap count as one in their length. nullopt: no horizon is measured, or the
/// vehicle leaves all bounds. Throws std::invalid_argument as predict() does.
[[nodiscard]] std::optional<Refinement> refined(const config::Layout& prior,
                                                const std::vector<Parameter>& parameters, Eigen::VectorXd start,
                                                const std::vector<RecordedMotion>& recordings, unsigned threads);

}  // namespace navcal::identify
