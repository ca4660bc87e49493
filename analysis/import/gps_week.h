// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace navcal::analysis {

/// UTC (Unix nanoseconds) of a time of GPS. The leap seconds are those of IERS Bulletin C: 13 at the end of 1999,
/// and one more at each date below; none is announced after 2017.
[[nodiscard]] constexpr std::int64_t utc_of_gps_week(std::int64_t week, std::int64_t ms_of_week) {
  constexpr std::int64_t kGpsEpoch_s = 315'964'800;  // 1980-01-06
  constexpr std::int64_t kWeek_s = 604'800;
  // Unix seconds of 2006-01-01, 2009-01-01, 2012-07-01, 2015-07-01, 2017-01-01.
  constexpr std::array<std::int64_t, 5> kSteps_s{1'136'073'600, 1'230'768'000, 1'341'100'800, 1'435'708'800,
                                                 1'483'228'800};
  const std::int64_t gps_s = kGpsEpoch_s + week * kWeek_s + ms_of_week / 1000;
  std::int64_t leap_s = 13;
  for (const std::int64_t step_s : kSteps_s) {
    if (gps_s - leap_s - 1 >= step_s) ++leap_s;
  }
  return (gps_s - leap_s) * 1'000'000'000 + ms_of_week % 1000 * 1'000'000;
}

}  // namespace navcal::analysis
