// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "devices/instrument_model.h"
#include "gap/data/innovations.h"
#include "gap/inference/prediction_error_filter.h"

namespace navcal::gap {

/// What a mission's innovations look like apart from their numbers.
struct Layout {
  Eigen::Index intervals = 0;
  std::vector<int> fix_numbers;  ///< since surfacing, of each fix
};

/// Makes innovations white: those of the grid less what all channels' past says of them, those of fixes each
/// through the prediction error filter of an autoregression of order 3, then all of an instant through the inverse
/// of the Cholesky factor of their covariance. It is linear and the same for residuals and regressors. Learnt from
/// simulated missions of the nominal vehicle: learnt from the mission to be diagnosed, it would take part of the
/// gap for noise.
class Whitening {
 public:
  static constexpr Eigen::Index kFixOrder = 3;

  Whitening() = default;
  /// From residuals that hold nothing but noise.
  explicit Whitening(std::span<const Innovations> noise, std::span<const Layout> layouts);

  /// By the noise of the instruments only, each channel and instant for itself: enough to find biases.
  [[nodiscard]] static Whitening nominal(const devices::InstrumentModel& instruments);

  /// All channels of all intervals, then those of all fixes. What was not measured, and the time in which the
  /// estimator settles, are zero.
  [[nodiscard]] Eigen::VectorXd operator()(const Innovations& innovations, const Layout& layout) const;
  /// How many numbers of an answer are measurements.
  [[nodiscard]] static Eigen::Index count(const Eigen::VectorXd& white);

  // For keeping it in a file.
  PredictionErrorFilter grid_filter;
  Eigen::MatrixXd fix_filter;               ///< order x channels
  Eigen::MatrixXd grid_factor, fix_factor;  ///< lower triangles
};

}  // namespace navcal::gap
