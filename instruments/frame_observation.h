// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace navcal::instruments {

/// One frame of a periodic stream and its time of observation.
struct FrameObservation {
  /// Latest monotonic time at which it can have been measured: arrival minus wire time minus nominal latency.
  std::int64_t observed_ns = 0;
  std::optional<std::uint8_t> sequence{};  ///< the device's counter, where it has one (wraps at 256)
  bool backlog = false;  ///< more of the stream lay behind it in the same read: the host was late
  std::optional<std::int64_t> device_time_ns{};  ///< time of validity by the device's own clock
  bool paces = true;                             ///< a tick of the stream; must be true without a device time
};

}  // namespace navcal::instruments
