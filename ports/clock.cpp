// SPDX-License-Identifier: Apache-2.0
#include <time.h>

#include "ports/port.h"

namespace navcal::ports {

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace navcal::ports
