// SPDX-License-Identifier: Apache-2.0
#include "daemon/system_clock.h"

#include <sys/timex.h>

#include <ctime>

#include "base/durations.h"
#include "ports/port.h"

namespace navcal::daemon {
namespace {

constexpr std::int64_t kMicrosecond_ns = 1'000;

std::int64_t realtime_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * base::kSecond_ns + now.tv_nsec;
}

}  // namespace

pipeline::SystemClockReading read_system_clock() {
  pipeline::SystemClockReading reading;
  // The real time between two monotonic readings belongs to their middle; the closest of three pairs is taken, as
  // the process may be interrupted between them.
  std::int64_t closest_ns = INT64_MAX;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t before_ns = ports::monotonic_ns();
    const std::int64_t real_ns = realtime_ns();
    const std::int64_t after_ns = ports::monotonic_ns();
    if (after_ns - before_ns >= closest_ns) continue;
    closest_ns = after_ns - before_ns;
    reading.monotonic_ns = before_ns + closest_ns / 2;
    reading.realtime_ns = real_ns;
  }
  timex state{};
  const int status = adjtimex(&state);
  reading.synchronised = status != -1 && status != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
  reading.max_error_ns = status == -1 ? 0 : state.maxerror * kMicrosecond_ns;
  return reading;
}

}  // namespace navcal::daemon
