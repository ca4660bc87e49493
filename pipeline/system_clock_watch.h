// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {

/// The system's clock against the monotonic one, read together (the reader is in daemon/).
struct SystemClockReading {
  std::int64_t monotonic_ns = 0;
  std::int64_t realtime_ns = 0;
  bool synchronised = false;      ///< the kernel believes so (adjtimex: not STA_UNSYNC)
  std::int64_t max_error_ns = 0;  ///< adjtimex's maxerror
};

/// Decides when a reading of the system clock becomes the mapping in force. A value machine.
/// - The narrower bound wins; an unsynchronised clock has none, and serves only while nothing better is known.
/// - A clock that shows a time before 2020 is not UTC.
/// - A step is reported and never followed as long as the mapping in force is still the better one.
class SystemClockWatch {
 public:
  struct Outcome {
    std::optional<UtcMapping> mapping;    ///< take this into force
    std::optional<std::int64_t> step_ns;  ///< the clock was set by this much since the reading before
  };
  Outcome update(const SystemClockReading& reading, const UtcMapping& in_force);

 private:
  std::optional<std::int64_t> last_offset_ns_;
  std::int64_t last_monotonic_ns_ = 0;
};

/// Width of a mapping's bound at another time: it grows by what an undisciplined oscillator may drift.
[[nodiscard]] std::int64_t bound_at(const UtcMapping& mapping, std::int64_t monotonic_ns);

}  // namespace navcal::pipeline
