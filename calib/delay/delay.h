// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

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

}  // namespace navcal::calib
