// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "instruments/samples.h"

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

/// Finds the surfacings in the readings of a depth gauge and of a receiver. No clock, no memory.
///
/// The antenna dives when the depth exceeds that of the antenna by 0.15 m, and surfaces when the depth falls to
/// that of the antenna: waves and the noise of the gauge lie between. If it dives again before a fix, both dives
/// are one, and the time of surfacing is the last one. A loss of fixes at the surface is none. Without any reading
/// of the depth, every stretch of 10 s or more without fixes counts, with an unknown time of surfacing.
class SurfacingWatch {
 public:
  explicit SurfacingWatch(double antenna_depth_m) : antenna_depth_m_(antenna_depth_m) {}

  /// Times of validity on the monotonic clock.
  void depth(std::int64_t time_ns, double depth_m);
  /// A reading of the receiver that has a position. The surfacing that it ended, if any; once.
  [[nodiscard]] std::optional<Surfacing> fix(std::int64_t time_ns, const instruments::GpsSample& gps);

 private:
  [[nodiscard]] bool ends_surfacing(std::int64_t time_ns) const;

  double antenna_depth_m_;
  bool has_gauge_ = false, under_ = false;
  std::optional<std::int64_t> last_fix_ns_, dived_ns_, surfaced_ns_;
  double deepest_m_ = 0;  ///< since it dived
};

}  // namespace navcal::pipeline
