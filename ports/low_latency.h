// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "ports/sysfs.h"

namespace navcal::ports {

/// Measures that were taken for a port's latency, as text, and the state to restore.
struct LowLatency {
  std::string report;
  std::optional<int> former_flags;  ///< of the driver, to be given back by restore_latency()
};

/// Asks the driver (ASYNC_LOW_LATENCY) and, for FTDI adapters, the 16 ms timer in sysfs to hand over bytes at
/// once. Reports only what it reads back.
[[nodiscard]] LowLatency ask_low_latency(int fd, const SysfsTty& sysfs);
void restore_latency(int fd, const LowLatency& asked);

}  // namespace navcal::ports
