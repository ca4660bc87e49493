// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/samples.h"
#include "pipeline/surfacing.h"

namespace navcal::pipeline {

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
