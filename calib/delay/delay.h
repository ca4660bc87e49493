// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "calib/archive.h"

namespace navcal::calib {

/// Delay of one instrument against another: positive, it shows what was true so long before its stamp.
struct Delay {
  double delay_s = 0;
  double std_s = std::numeric_limits<double>::infinity();
  double stamps_std_s = 0;  ///< the part of std_s that the stamps of both instruments claim of themselves
  std::uint64_t readings = 0;
  /// Standard deviation of the rate of turn over the readings: near zero, nothing can be known of a delay.
  double rate_spread_rad_s = 0;
};

/// Tests whether an estimate of a Kalman filter wanders as its covariance says. If the innovations are
/// independent, the estimate is a martingale: between two times the variance of its change is the decrease of
/// its variance. Model errors correlate neighbouring innovations and enlarge the changes over blocks.
class DelayBlocks {
 public:
  /// Called at each reading with the filter's estimate and its variance.
  void update(double estimate, double variance);
  /// Factor for the filter's variance, at least `noise_scale` (that of single innovations, 1: as stated).
  /// `noise_scale` is weighted like five blocks.
  [[nodiscard]] double variance_scale(double noise_scale) const;
  void archive(Archive& archive) { archive(in_block_, estimate_, variance_, square_, blocks_); }

 private:
  std::uint32_t in_block_ = 0;
  double estimate_ = 0, variance_ = 0;  ///< at the beginning of the block
  double square_ = 0;                   ///< sum of squared changes over their variances
  std::uint32_t blocks_ = 0;
};

}  // namespace navcal::calib
