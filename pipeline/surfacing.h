// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace navcal::pipeline {

/// A return from a dive to the first fix after it. Times are times of validity on the monotonic clock. Without a
/// depth gauge only the stretch without fixes is known.
struct Surfacing {
  std::int64_t last_fix_ns = 0;             ///< before it; 0: there was none
  std::optional<std::int64_t> dived_ns;     ///< the antenna went under water
  std::optional<std::int64_t> surfaced_ns;  ///< it came out again, for the last time before the fix
  std::int64_t first_fix_ns = 0;
  std::optional<double> deepest_m;
  std::optional<std::uint8_t> visible, tracked;  ///< satellites at the first fix
  std::optional<double> dop;                     ///< of the first fix

  /// Seconds from the last fix before to the first after; nullopt if there was none before.
  [[nodiscard]] std::optional<double> without_fix_s() const;
  /// Seconds the antenna was under water.
  [[nodiscard]] std::optional<double> submerged_s() const;
  /// Time to first fix, seconds. A fix states a full second, so it is known to about a second.
  [[nodiscard]] std::optional<double> time_to_first_fix_s() const;
};

/// "83 s under water, down to 3.1 m; first fix 6.0 s after surfacing, 7 satellites, DOP 3.0".
[[nodiscard]] std::string words_for(const Surfacing& surfacing);

}  // namespace navcal::pipeline
