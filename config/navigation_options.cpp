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
           .description = "Interval at which the estimate is reported and logged.",
           .unit = kSeconds,
           .low = 0.05,
           .high = 60},
          [](auto& s) -> auto& { return s.navigation.interval_s; }),
      real<S>(
          {.table = "navigation",
           .key = "heading_error_deg",
           .description = "Constant error of the heading along a leg, one standard deviation, without an active "
                          "calibration of the compass.",
           .unit = kDegrees,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.navigation.heading_error_rad; }),
      real<S>(
          {.table = "navigation",
           .key = "heading_error_calibrated_deg",
           .description = "Constant error of the heading along a leg, one standard deviation, with an active "
                          "calibration.",
           .unit = kDegrees,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.navigation.heading_error_calibrated_rad; }),
      real<S>(
          {.table = "navigation",
           .key = "speed_error_percent",
           .description = "Constant error of the speed that is computed from the shaft, one standard deviation.",
           .unit = kPercent,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.navigation.speed_error; }),
      real<S>(
          {.table = "navigation",
           .key = "speed_lag_s",
           .description = "Time constant of the first-order lag from shaft speed to vehicle speed; 0: no lag.",
           .unit = kSeconds,
           .low = 0,
           .high = 60},
          [](auto& s) -> auto& { return s.navigation.speed_lag_s; }),
      real<S>(
          {.table = "navigation",
           .key = "dvl_noise_m_s",
           .description = "Random error of one velocity of a DVL that states none, one standard deviation.",
           .unit = kMetresPerSecond,
           .low = 0.0001,
           .high = 1},
          [](auto& s) -> auto& { return s.navigation.dvl_noise_m_s; }),
      real<S>(
          {.table = "navigation",
           .key = "dvl_scale_error_percent",
           .description = "Constant error of the scale of a DVL (speed of sound), one standard deviation.",
           .unit = kPercent,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.navigation.dvl_scale_error; }),
      real<S>(
          {.table = "navigation",
           .key = "dvl_alignment_error_deg",
           .description = "Constant error of the direction in which a DVL is mounted, one standard deviation.",
           .unit = kDegrees,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.navigation.dvl_alignment_error_rad; }),
      real<S>(
          {.table = "navigation",
           .key = "water_density_kg_m3",
           .description = "Density of the water, for the depth of a gauge that states a pressure alone.",
           .unit = kKilogramsPerCubicMetre,
           .low = 900,
           .high = 1300},
          [](auto& s) -> auto& { return s.navigation.water_density_kg_m3; }),
      real<S>(
          {.table = "navigation",
           .key = "air_pressure_hPa",
           .description = "Pressure of the air at the surface, for the same.",
           .unit = kHectopascals,
           .low = 500,
           .high = 1200},
          [](auto& s) -> auto& { return s.navigation.air_pressure_Pa; }),
      real<S>(
          {.table = "navigation",
           .key = "max_error_m",
           .description =
               "Largest position error (95 %) that the mission allows; the advice to surface keeps to it. "
               "0: no advice.",
           .unit = kMetres,
           .low = 0,
           .high = 100000},
          [](auto& s) -> auto& { return s.navigation.max_error_m; }),
      real<S>(
          {.table = "navigation",
           .key = "altitude_noise_m",
           .description = "Noise of one reading of the altimeter, one standard deviation.",
           .unit = kMetres,
           .low = 0.001,
           .high = 100},
          [](auto& s) -> auto& { return s.navigation.altitude_noise_m; }),
      real<S>(
          {.table = "navigation",
           .key = "altimeter_range_m",
           .description = "Greatest distance that the altimeter measures; readings beyond it are left out.",
           .unit = kMetres,
           .low = 0.1,
           .high = 12000},
          [](auto& s) -> auto& { return s.navigation.altimeter_range_m; }),
      real<S>(
          {.table = "navigation",
           .key = "min_altitude_m",
           .description = "The alarm floor_near is raised when the height above the sea floor is less; 0: never.",
           .unit = kMetres,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.navigation.min_altitude_m; }),
      real<S>(
          {.table = "navigation",
           .key = "floor_warning_s",
           .description = "It is also raised when the height will be less within this time, as it changes now.",
           .unit = kSeconds,
           .low = 0,
           .high = 60},
          [](auto& s) -> auto& { return s.navigation.floor_warning_s; }),
  };
}

}  // namespace navcal::config
