// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "calib/archive.h"

namespace navcal::calib {

/// Whether an estimate of a Kalman filter wanders as its covariance says: between two times the variance of its
/// change is the decrease of its variance (the estimate is a martingale), if the innovations are independent. What
/// the model leaves out makes neighbouring innovations alike, and the changes over blocks larger.
class DelayBlocks {
 public:
  /// At each reading: the estimate and its variance by the filter.
  void update(double estimate, double variance);
  /// Factor for the filter's variance, at least `noise_scale` (that of single innovations, 1: as stated), which is
  /// worth five blocks.
  [[nodiscard]] double variance_scale(double noise_scale) const;
  void archive(Archive& archive) { archive(in_block_, estimate_, variance_, square_, blocks_); }

 private:
  std::uint32_t in_block_ = 0;
  double estimate_ = 0, variance_ = 0;  ///< at the beginning of the block
  double square_ = 0;                   ///< sum of squared changes over their variances
  std::uint32_t blocks_ = 0;
};

}  // namespace navcal::calib
