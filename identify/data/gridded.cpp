// SPDX-License-Identifier: Apache-2.0
#include "identify/data/gridded.h"

#include <limits>

#include "base/angles.h"

namespace navcal::identify {
namespace {

constexpr double kGap_s = 2;  ///< between readings, which are interpolated within

}  // namespace

std::vector<double> on_grid(const RecordedMotion& motion, Channel channel, std::size_t rows) {
  std::vector<double> out(rows, std::numeric_limits<double>::quiet_NaN());
  const auto& readings = motion[channel];
  std::size_t next = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double time_s = kGrid_s * static_cast<double>(k);
    while (next < readings.size() && readings[next].time_s < time_s) ++next;
    if (next == 0 || next == readings.size()) continue;
    const Reading &a = readings[next - 1], &b = readings[next];
    if (b.time_s - a.time_s > kGap_s) continue;
    const double change = describe(channel).is_angle ? base::wrapped(b.value - a.value) : b.value - a.value;
    out[k] = a.value + (time_s - a.time_s) / (b.time_s - a.time_s) * change;
  }
  return out;
}

}  // namespace navcal::identify
