// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/utc_mapping.h"

namespace navcal::daemon {

/// Reads the system's clock beside the monotonic one, and the kernel's state of that clock (adjtimex(2)).
[[nodiscard]] pipeline::SystemClockReading read_system_clock();

}  // namespace navcal::daemon
