// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace navcal::gap {

/// Predicts the channels of an interval from all channels of the intervals before it.
///
/// Model: a vector autoregression on means over windows that double in length with their distance (the idea of
/// Corsi's heterogeneous autoregression, 2009). The windows are the last interval, the one before, the two
/// before those, and so on to the last six seconds.
///
/// The estimator's gains of two per cent a frame have a memory of seconds, and the noise of one gyro appears in
/// the prediction errors of another. A filter of each channel's own last second would leave half of the
/// information about a drift, and a quarter of that about a depth scale.
class PredictionErrorFilter {
 public:
  static constexpr Eigen::Index kWindows = 7;

  /// Predicts nothing.
  PredictionErrorFilter() = default;
  /// `weights`: a row for each window and channel, window by window; a column for each channel predicted.
  explicit PredictionErrorFilter(Eigen::MatrixXd weights) : weights_(std::move(weights)) {}
  /// Fits the weights by least squares to rows of noise, one matrix for each mission; missing values are NaN.
  /// Rows before `from` only serve to predict.
  [[nodiscard]] static PredictionErrorFilter learnt(std::span<const Eigen::MatrixXd> noise, Eigen::Index from);

  /// Measured minus predicted. A missing value gives zero, and its prediction takes its place afterwards.
  [[nodiscard]] Eigen::MatrixXd errors(const Eigen::MatrixXd& rows) const;

  [[nodiscard]] const Eigen::MatrixXd& weights() const { return weights_; }

 private:
  Eigen::MatrixXd weights_;
};

}  // namespace navcal::gap
