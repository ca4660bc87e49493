// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "devices/instrument_model.h"
#include "gap/data/innovations.h"
#include "gap/inference/prediction_error_filter.h"

namespace navcal::gap {

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
