// SPDX-License-Identifier: Apache-2.0
#include "config/navigation_options.h"

namespace navcal::config {

std::vector<Option<Settings>> navigation_options() {
  using S = Settings;
  const NumberOf<S> number{"navigation"};
  return {
      boolean<S>(
          {.table = "navigation",
           .key = "enabled",
           .description = "Whether position, attitude and depth are estimated between fixes."},
          [](auto& s) -> auto& { return s.navigation.enabled; }),
      number(
          "interval_s", "Interval at which the estimate is reported and logged.", kSeconds, 0.05, 60,
          [](auto& s) -> auto& { return s.navigation.interval_s; }),
      number(
          "heading_error_deg",
          "Constant error of the heading along a leg, one standard deviation, without an active calibration of "
          "the compass.",
          kDegrees, 0, 90, [](auto& s) -> auto& { return s.navigation.heading_error_rad; }),
      number(
          "heading_error_calibrated_deg",
          "Constant error of the heading along a leg, one standard deviation, with an active calibration.",
          kDegrees, 0, 90, [](auto& s) -> auto& { return s.navigation.heading_error_calibrated_rad; }),
      number(
          "speed_error_percent",
          "Constant error of the speed that is computed from the shaft, one standard deviation.", kPercent, 0, 100,
          [](auto& s) -> auto& { return s.navigation.speed_error; }),
      number(
          "speed_lag_s", "Time constant of the first-order lag from shaft speed to vehicle speed; 0: no lag.",
          kSeconds, 0, 60, [](auto& s) -> auto& { return s.navigation.speed_lag_s; }),
      number(
          "dvl_noise_m_s", "Random error of one velocity of a DVL that states none, one standard deviation.",
          kMetresPerSecond, 0.0001, 1, [](auto& s) -> auto& { return s.navigation.dvl_noise_m_s; }),
      number(
          "dvl_scale_error_percent",
          "Constant error of the scale of a DVL (speed of sound), one standard deviation.", kPercent, 0, 100,
          [](auto& s) -> auto& { return s.navigation.dvl_scale_error; }),
      number(
          "dvl_alignment_error_deg",
          "Constant error of the direction in which a DVL is mounted, one standard deviation.", kDegrees, 0, 90,
          [](auto& s) -> auto& { return s.navigation.dvl_alignment_error_rad; }),
      number(
          "water_density_kg_m3", "Density of the water, for the depth of a gauge that states a pressure alone.",
          kKilogramsPerCubicMetre, 900, 1300, [](auto& s) -> auto& { return s.navigation.water_density_kg_m3; }),
      number(
          "air_pressure_hPa", "Pressure of the air at the surface, for the same.", kHectopascals, 500, 1200,
          [](auto& s) -> auto& { return s.navigation.air_pressure_Pa; }),
      number(
          "max_error_m",
          "Largest position error (95 %) that the mission allows; the advice to surface keeps to it. 0: no "
          "advice.",
          kMetres, 0, 100000, [](auto& s) -> auto& { return s.navigation.max_error_m; }),
      number(
          "altitude_noise_m", "Noise of one reading of the altimeter, one standard deviation.", kMetres, 0.001,
          100, [](auto& s) -> auto& { return s.navigation.altitude_noise_m; }),
      number(
          "altimeter_range_m", "Greatest distance that the altimeter measures; readings beyond it are left out.",
          kMetres, 0.1, 12000, [](auto& s) -> auto& { return s.navigation.altimeter_range_m; }),
      number(
          "min_altitude_m",
          "The alarm floor_near is raised when the height above the sea floor is less; 0: never.", kMetres, 0,
          1000, [](auto& s) -> auto& { return s.navigation.min_altitude_m; }),
      number(
          "floor_warning_s", "It is also raised when the height will be less within this time, as it changes now.",
          kSeconds, 0, 60, [](auto& s) -> auto& { return s.navigation.floor_warning_s; }),
  };
}

}  // namespace navcal::config
