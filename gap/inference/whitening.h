// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "devices/instrument_model.h"
#include "gap/data/innovations.h"

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

/// Shape of a mission's innovations, without their values.
struct Layout {
  Eigen::Index intervals = 0;
  std::vector<int> fix_numbers;  ///< since surfacing, of each fix
};

/// Whitens innovations. The prediction from the past of all channels is subtracted from those of the grid.
/// Those of fixes pass an autoregressive prediction error filter of order 3 each. Then all innovations of an
/// instant are multiplied by the inverse Cholesky factor of their covariance.
///
/// The filter is linear and the same for residuals and regressors. It is fitted to simulated missions of the
/// nominal vehicle: fitted to the mission at hand, it would treat part of the gap as noise.
class Whitening {
 public:
  static constexpr Eigen::Index kFixOrder = 3;

  Whitening() = default;
  /// Fits the filter to residuals that contain noise only.
  explicit Whitening(std::span<const Innovations> noise, std::span<const Layout> layouts);

  /// Whitening by the noise of the instruments only, separately for each channel and instant: enough to find
  /// biases.
  [[nodiscard]] static Whitening nominal(const devices::InstrumentModel& instruments);

  /// All channels of all intervals, then those of all fixes. Missing values, and those during the settling of
  /// the estimator, are zero.
  [[nodiscard]] Eigen::VectorXd operator()(const Innovations& innovations, const Layout& layout) const;
  /// Number of measured values in a whitened vector.
  [[nodiscard]] static Eigen::Index count(const Eigen::VectorXd& white);

  // Public so that the null bank's file can store it.
  PredictionErrorFilter grid_filter;
  Eigen::MatrixXd fix_filter;               ///< order x channels
  Eigen::MatrixXd grid_factor, fix_factor;  ///< lower triangles
};

}  // namespace navcal::gap
