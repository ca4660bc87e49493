// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "config/settings.h"
#include "nav/altitude_filter.h"

namespace navcal::pipeline {

/// Decides when the sea floor is near: the altitude is below its limit, or will be within the time of warning at a
/// rate that is certain to two standard deviations. The floor is far again when neither has held for kClear_ns and
/// the altitude is kHysteresis_m above its limit.
class FloorWatch {
 public:
  static constexpr std::int64_t kClear_ns = 2'000'000'000;
  static constexpr double kHysteresis_m = 0.3;

  explicit FloorWatch(const config::NavigationSettings& settings)
      : min_altitude_m_(settings.min_altitude_m), warning_s_(settings.floor_warning_s) {}

  /// A new altitude. Returns true when the floor became near or far.
  [[nodiscard]] bool take(std::int64_t time_ns, const nav::Altitude& altitude);
  [[nodiscard]] bool is_near() const { return near_; }

 private:
  double min_altitude_m_, warning_s_;
  bool near_ = false;
  std::int64_t last_near_ns_ = 0;
};

}  // namespace navcal::pipeline
