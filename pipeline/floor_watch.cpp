// SPDX-License-Identifier: Apache-2.0
#include "pipeline/floor_watch.h"

namespace navcal::pipeline {

bool FloorWatch::take(std::int64_t time_ns, const nav::Altitude& altitude) {
  constexpr double kCertain = 2;
  if (min_altitude_m_ <= 0) return false;
  const double limit_m = min_altitude_m_ + (near_ ? kHysteresis_m : 0);
  const bool comes = altitude.rate_m_s < -kCertain * altitude.rate_std_m_s &&
                     altitude.altitude_m + altitude.rate_m_s * warning_s_ < limit_m;
  const bool is_near = altitude.altitude_m < limit_m || comes;
  if (is_near) last_near_ns_ = time_ns;
  if (is_near == near_ || (near_ && time_ns - last_near_ns_ < kClear_ns)) return false;
  near_ = is_near;
  return true;
}

}  // namespace navcal::pipeline
