// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace navcal::web {

/// Lets one of a stream's values through in each interval. A value that comes up to a tenth of the interval early
/// passes, so that a stream at just this rate is not halved by its jitter.
class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static Clock::duration interval_of(double rate_Hz) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate_Hz));
  }
  [[nodiscard]] bool pass(Clock::time_point now, Clock::duration interval) {
    if (now + interval / 10 < due_) return false;
    due_ = std::max(due_ + interval, now + interval * 9 / 10);
    return true;
  }

 private:
  Clock::time_point due_{};
};

}  // namespace navcal::web
