// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"

namespace navcal::config {

std::vector<Option<Settings>> navigation_options() {
  const auto table = table_of<Settings>("navigation", &Settings::navigation);
  return {
      table.boolean("enabled", &NavigationSettings::enabled,
                    "Whether position, attitude and depth are estimated between fixes."),
      table.number("interval_s", &NavigationSettings::interval_s, kSeconds, 0.05, 60,
                   "Interval at which the estimate is reported and logged."),
      table.number("heading_error_deg", &NavigationSettings::heading_error_rad, kDegrees, 0, 90,
                   "Constant error of the heading along a leg, one standard deviation, without an active "
                   "calibration of the compass."),
      table.number(
          "heading_error_calibrated_deg", &NavigationSettings::heading_error_calibrated_rad, kDegrees, 0, 90,
          "Constant error of the heading along a leg, one standard deviation, with an active calibration."),
      table.number("speed_error_percent", &NavigationSettings::speed_error, kPercent, 0, 100,
                   "Constant error of the speed that is computed from the shaft, one standard deviation."),
      table.number("speed_lag_s", &NavigationSettings::speed_lag_s, kSeconds, 0, 60,
                   "Time constant of the first-order lag from shaft speed to vehicle speed; 0: no lag."),
      table.number("dvl_noise_m_s", &NavigationSettings::dvl_noise_m_s, kMetresPerSecond, 0.0001, 1,
                   "Random error of one velocity of a DVL that states none, one standard deviation."),
      table.number("dvl_scale_error_percent", &NavigationSettings::dvl_scale_error, kPercent, 0, 100,
                   "Constant error of the scale of a DVL (speed of sound), one standard deviation."),
      table.number("dvl_alignment_error_deg", &NavigationSettings::dvl_alignment_error_rad, kDegrees, 0, 90,
                   "Constant error of the direction in which a DVL is mounted, one standard deviation."),
      table.number("water_density_kg_m3", &NavigationSettings::water_density_kg_m3, kKilogramsPerCubicMetre, 900,
                   1300, "Density of the water, for the depth of a gauge that states a pressure alone."),
      table.number("air_pressure_hPa", &NavigationSettings::air_pressure_Pa, kHectopascals, 500, 1200,
                   "Pressure of the air at the surface, for the same."),
      table.number("max_error_m", &NavigationSettings::max_error_m, kMetres, 0, 100000,
                   "Largest position error (95 %) that the mission allows; the advice to surface keeps to it. 0: "
                   "no advice."),
      table.number("altitude_noise_m", &NavigationSettings::altitude_noise_m, kMetres, 0.001, 100,
                   "Noise of one reading of the altimeter, one standard deviation."),
      table.number("altimeter_range_m", &NavigationSettings::altimeter_range_m, kMetres, 0.1, 12000,
                   "Greatest distance that the altimeter measures; readings beyond it are left out."),
      table.number("min_altitude_m", &NavigationSettings::min_altitude_m, kMetres, 0, 1000,
                   "The alarm floor_near is raised when the height above the sea floor is less; 0: never."),
      table.number("floor_warning_s", &NavigationSettings::floor_warning_s, kSeconds, 0, 60,
                   "It is also raised when the height will be less within this time, as it changes now."),
  };
}

}  // namespace navcal::config
