// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calib/archive.h"

namespace navcal::calib {

/// Model: the row of an innovation, (innovation at the prior's constants; its gradient in scale, B, C, D, E),
/// bears the noise of gyro and compass in its gradient, too, since measured rate and measured heading are
/// regressors. This carries the second moments of that noise through TurnFilter's first stage and sums what noise
/// alone puts into the products of rows. Rows are linear in the noise; of the harmonics that is to first order.
/// Radians.
class TurnNoise {
 public:
  using Row = Eigen::Matrix<double, 6, 1>;
  using Products = Eigen::Matrix<double, 6, 6>;

  /// Restarts the heading with one reading, whose noise enters a row along `direction`.
  void start(const Row& direction, double variance);
  /// The turn by gyro adds noise along `direction`.
  void predict(double bias_time_s, const Row& direction, double variance);
  /// A reading is weighed with 1/innovation_variance and moves heading and bias by `gain`.
  void correct(const Row& direction, double variance, double innovation_variance, const Eigen::Vector2d& gain);

  /// Expectation of the sum of row * row' / innovation_variance, as far as it is noise.
  [[nodiscard]] const Products& expected() const { return expected_; }

  void archive(Archive& archive) { archive(heading_, heading_bias_, bias_, expected_); }

 private:
  // Moments of the noise in the rows of heading and bias: heading with heading, with bias, bias with bias.
  Products heading_ = Products::Zero(), heading_bias_ = Products::Zero(), bias_ = Products::Zero();
  Products expected_ = Products::Zero();
};

}  // namespace navcal::calib
