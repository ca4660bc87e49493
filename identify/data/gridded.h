// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "identify/data/recorded_motion.h"

namespace navcal::identify {

inline constexpr double kGrid_s = 0.1;

/// Readings of a channel at multiples of kGrid_s, interpolated, NaN where none are near; angles are interpolated
/// without jumps.
[[nodiscard]] std::vector<double> on_grid(const RecordedMotion& motion, Channel channel, std::size_t rows);
/// Points of the grid within a recording.
[[nodiscard]] inline std::size_t grid_rows(const RecordedMotion& motion) {
  return static_cast<std::size_t>(motion.duration_s / kGrid_s) + 1;
}

}  // namespace navcal::identify
