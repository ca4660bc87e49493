// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace navcal::gap {

/// Predicts the channels of an interval from all channels of those before it, by means over windows that double in
/// length with their distance: the last interval, the one before, the two before those, and so on to the last six
/// seconds (the idea of Corsi's heterogeneous autoregression, 2009). Gains of two per cent a frame remember for
/// seconds, and one gyro's noise is what another's prediction is off by: each channel's own last second leaves
/// half of what is known about a drift, and a quarter about a depth's scale.
class PredictionErrorFilter {
 public:
  static constexpr Eigen::Index kWindows = 7;

  /// Predicts nothing.
  PredictionErrorFilter() = default;
  /// `weights`: a row for each window and channel, window by window; a column for each channel predicted.
  explicit PredictionErrorFilter(Eigen::MatrixXd weights) : weights_(std::move(weights)) {}
  /// By least squares from rows of noise, one matrix for each mission; what was not measured is NaN. Rows before
  /// `from` only serve to predict.
  [[nodiscard]] static PredictionErrorFilter learnt(std::span<const Eigen::MatrixXd> noise, Eigen::Index from);

  /// Measured less predicted. What was not measured leaves zero and is taken to be as predicted afterwards.
  /// Linear.
  [[nodiscard]] Eigen::MatrixXd errors(const Eigen::MatrixXd& rows) const;

  [[nodiscard]] const Eigen::MatrixXd& weights() const { return weights_; }

 private:
  Eigen::MatrixXd weights_;
};

}  // namespace navcal::gap
