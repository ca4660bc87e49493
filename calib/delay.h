#pragma once

#include <cstdint>
#include <limits>

namespace navcal::calib {

/// Delay of one instrument against another: positive, it shows what was true so long before its stamp.
struct Delay {
  double delay_s = 0;
  double std_s = std::numeric_limits<double>::infinity();
  std::uint64_t readings = 0;
  /// Root of the mean square of what the delay is seen by, the change of the rate of turn (rad/s): near zero, and
  /// nothing can be known.
  double rate_spread_rad_s = 0;
};

}  // namespace navcal::calib
