// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/durations.h"

namespace navcal::pipeline {

/// A mapping to UTC that is older is replaced, even where the new one differs by nothing.
inline constexpr std::int64_t kMappingRefreshAge_ns = 60 * base::kSecond_ns;

/// 2020-01-01. A computer's clock that shows an earlier time was not set since the computer was switched on.
inline constexpr std::int64_t kFirstUtc_ns = 1'577'836'800 * base::kSecond_ns;

/// utc = monotonic + offset, to within `bound`. It is recorded, so that replay maps as the daemon did.
struct UtcMapping {
  enum class Source : std::uint8_t { none, file, system, system_synchronised, gps };
  static constexpr std::int64_t kUnknownBound = INT64_MAX;

  Source source = Source::none;
  std::int64_t offset_ns = 0;
  std::int64_t bound_ns =
      kUnknownBound;       ///< half width at `at_ns`; grows afterwards with the oscillator's tolerance
  std::int64_t at_ns = 0;  ///< monotonic time at which it was found

  [[nodiscard]] std::int64_t to_utc(std::int64_t monotonic_ns) const { return monotonic_ns + offset_ns; }
};

/// "none", "file", "system", "system-synchronised", "gps".
[[nodiscard]] std::string_view name_of(UtcMapping::Source source);

/// Width of a mapping's bound at another time: it grows by what an undisciplined oscillator may drift.
[[nodiscard]] std::int64_t bound_at(const UtcMapping& mapping, std::int64_t monotonic_ns);

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

}  // namespace navcal::pipeline
