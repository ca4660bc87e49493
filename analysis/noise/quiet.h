// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/noise/series.h"

/// Parts of a recording in which the vehicle is at rest, by the readings alone. Windows of 8 s are divided into
/// blocks of 1 s. A window is at rest when each channel that shows motion
///
/// - has block means that vary no more than the noise of its own readings predicts (from the differences of
///   consecutive readings, as in reading_noise.h, a filter included), or than `slow_limit`;
/// - has differences of consecutive readings no larger than in the channel's other windows at rest: no vibration;
/// - has a mean within `mean_limit`, where the channel has one.
namespace navcal::analysis {

/// A channel that shows motion.
struct MotionChannel {
  std::string name;  ///< for messages
  std::string unit;
  const Series* series = nullptr;
  double slow_limit = 0;  ///< standard deviation of block means that passes for rest, whatever the noise
  std::optional<double> mean_limit;
};

/// The window that is nearest to rest where none is, with the channel that exceeds its limit most.
struct QuietestWindow {
  double from_s = 0;
  std::string channel, unit;
  std::string what;  ///< "varies by", "has a mean of", "vibrates by"
  double value = 0, limit = 0;
};

struct QuietParts {
  std::vector<Interval> intervals;         ///< in order, at least 10 s long, apart from each other
  std::optional<QuietestWindow> quietest;  ///< where there are none, if a window could be judged at all
};

[[nodiscard]] QuietParts quiet_parts(const std::vector<MotionChannel>& channels, double duration_s);

}  // namespace navcal::analysis
