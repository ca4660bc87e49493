// SPDX-License-Identifier: Apache-2.0
#include "config/navigation_options.h"

namespace navcal::config {

std::vector<Option<Settings>> navigation_options() {
  using S = Settings;
  return {
      boolean<S>(
          {.table = "navigation",
           .key = "enabled",
           .description = "Whether position, attitude and depth are estimated between fixes."},
          [](auto& s) -> auto& { return s.navigation.enabled; }),
      real<S>(
          {.table = "navigation",
           .key = "interval_s",
           .description = "How often the estimate is reported and logged.",
           .unit = kSeconds,
           .low = 0.05,
           .high = 60},
          [](auto& s) -> auto& { return s.navigation.interval_s; }),
      real<S>(
          {.table = "navigation",
           .key = "heading_error_deg",
           .description = "How far the heading may be off all along a leg, one standard deviation, while no "
                          "calibration of the compass is in force.",
           .unit = kDegrees,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.navigation.heading_error_rad; }),
      real<S>(
          {.table = "navigation",
           .key = "heading_error_calibrated_deg",
           .description = "Likewise while one is.",
           .unit = kDegrees,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.navigation.heading_error_calibrated_rad; }),
      real<S>(
          {.table = "navigation",
           .key = "speed_error_percent",
           .description = "How far the speed by the shaft may be off all along, one standard deviation.",
           .unit = kPercent,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.navigation.speed_error; }),
      real<S>(
          {.table = "navigation",
           .key = "speed_lag_s",
           .description = "How fast the vehicle's speed follows its shaft's: the time constant of a first-order "
                          "lag; 0: at once.",
           .unit = kSeconds,
           .low = 0,
           .high = 60},
          [](auto& s) -> auto& { return s.navigation.speed_lag_s; }),
  };
}

}  // namespace navcal::config
