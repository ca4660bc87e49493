// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "config/options.h"

namespace navcal::config {
namespace {

struct OlderName {
  std::string_view key, name;
};

/// Keys of [calibration] for what is in [instruments] now.
constexpr std::array<OlderName, 4> kOlderNames{{
    {"gyro_noise_deg_s", "instruments.imu_gyro_noise_deg_s"},
    {"tilt_lag_s", "instruments.compass_tilt_lag_s"},
    {"position_noise_m", "instruments.gps_position_noise_m"},
    {"velocity_noise_m_s", "instruments.gps_velocity_noise_m_s"},
}};

}  // namespace

std::vector<Option<Settings>> instrument_options() {
  const auto compass = table_of<Settings>(
      "instruments", [](auto& s) -> auto& { return s.instruments.compass; });
  const auto imu = table_of<Settings>(
      "instruments", [](auto& s) -> auto& { return s.instruments.imu; });
  const auto gps = table_of<Settings>(
      "instruments", [](auto& s) -> auto& { return s.instruments.gps; });
  const auto motor = table_of<Settings>(
      "instruments", [](auto& s) -> auto& { return s.instruments.motor; });
  return {
      compass.number("compass_field_noise_uT", &CompassAccuracy::field_noise_uT, kMicrotesla, 0.001, 20,
                     "Noise of each axis of the compass's field."),
      compass.number("compass_tilt_noise_deg", &CompassAccuracy::tilt_noise_rad, kDegrees, 0.001, 20,
                     "Noise of the inclinometer's roll and pitch."),
      compass.number("compass_tilt_lag_s", &CompassAccuracy::tilt_lag_s, kSeconds, 0, 10,
                     "First-order lag of the inclinometer; 0 when it has none."),
      compass.number("compass_temperature_noise_C", &CompassAccuracy::temperature_noise_C, kCelsius, 0, 20,
                     "Noise of the compass's thermometer."),
      imu.number("imu_gyro_noise_deg_s", &ImuAccuracy::gyro_noise_rad_s, kDegreesPerSecond, 0.0001, 20,
                 "Noise of each gyro's rate."),
      imu.number("imu_turn_on_bias_deg_s", &ImuAccuracy::turn_on_bias_rad_s, kDegreesPerSecond, 0.0001, 20,
                 "Bias of each gyro, new at each power-on."),
      imu.number("imu_force_noise_m_s2", &ImuAccuracy::force_noise_m_s2, kMetresPerSecondSquared, 0.0001, 10,
                 "Noise of each accelerometer."),
      imu.number("imu_depth_noise_m", &ImuAccuracy::depth_noise_m, kMetres, 0.0001, 10,
                 "Noise of the depth gauge."),
      gps.number("gps_position_noise_m", &GpsAccuracy::position_noise_m, kMetres, 0.001, 100,
                 "Noise of a position fix, each axis."),
      gps.number("gps_velocity_noise_m_s", &GpsAccuracy::velocity_noise_m_s, kMetresPerSecond, 0.001, 10,
                 "Noise of the receiver's velocity, each axis."),
      gps.number("gps_antenna_depth_m", &GpsAccuracy::antenna_depth_m, kMetres, 0, 100,
                 "The receiver has no fixes while the vehicle's origin is deeper than this."),
      gps.number("gps_least_search_s", &GpsAccuracy::least_search_s, kSeconds, 0, 3600,
                 "Shortest time from sight of the sky to the first fix."),
      gps.number("gps_longest_search_s", &GpsAccuracy::longest_search_s, kSeconds, 0, 3600,
                 "Longest such time; not less than the shortest."),
      gps.choice("gps_search_model", &GpsAccuracy::search_model, {"uniform", "receiver-state"},
                 "Model of the search: uniform between these two times, or by what the receiver still knows "
                 "(receiver-state)."),
      gps.number("gps_hot_start_s", &GpsAccuracy::hot_start_s, kSeconds, 0, 3600,
                 "Mean search with valid ephemerides (receiver-state)."),
      gps.number("gps_warm_start_s", &GpsAccuracy::warm_start_s, kSeconds, 0, 3600,
                 "Mean search with time and position, without ephemerides (receiver-state)."),
      gps.number("gps_cold_start_s", &GpsAccuracy::cold_start_s, kSeconds, 0, 3600,
                 "Mean search without time or position (receiver-state)."),
      gps.number("gps_ephemeris_life_s", &GpsAccuracy::ephemeris_life_s, kSeconds, 1, 86400,
                 "Longest life of an ephemeris without reception; the shortest is half of it."),
      motor.number("motor_fin_noise_deg", &MotorAccuracy::fin_noise_rad, kDegrees, 0, 20,
                   "Noise of the fin angles that the motor card reports."),
      motor.number("motor_current_noise_A", &MotorAccuracy::current_noise_A, kAmperes, 0, 100,
                   "Noise of the motor's current."),
  };
}

std::vector<Option<Settings>> calibration_options() {
  const auto table = table_of<Settings>("calibration", &Settings::calibration);
  std::vector<Option<Settings>> options{
      table.boolean("enabled", &CalibrationSettings::enabled, "Whether the calibrators run at all."),
      table.boolean("automatic", &CalibrationSettings::automatic,
                    "Whether estimates become active by themselves; otherwise only by calibration.accept."),
      table.number("margin_percent", &CalibrationSettings::margin, kPercent, 0, 90,
                   "Improvement on held-out readings that an estimate needs to become active by itself."),
      table.number("motor_settle_s", &CalibrationSettings::motor_settle_s, kSeconds, 0, 60,
                   "Time after a switching of the motor during which magnetic readings are left out."),
      table.number("heading_noise_deg", &CalibrationSettings::heading_noise_rad, kDegrees, 0, 20,
                   "Noise of the compass's heading that the calibrators reckon with, one standard deviation of a "
                   "reading; 0: it follows from the compass in [instruments] (0.5 deg for the reference one)."),
      table.number("field_noise_uT", &CalibrationSettings::field_noise_uT, kMicrotesla, 0, 20,
                   "Noise of each axis of the magnetic field that the calibrators reckon with; 0: it follows from "
                   "the compass in [instruments] (0.2 uT for the reference one)."),
      table.number(
          "bias_walk_deg_s", &CalibrationSettings::bias_walk_rad_s, kDegreesPerSecond, 0, 10,
          "Random walk of a gyro's bias in one second (grows with the root of time), one standard deviation."),
      table.number(
          "compass_delay_ms", &CalibrationSettings::compass_delay_s, kMilliseconds, 0, 1900,
          "Known delay of the compass's readings behind their times, taken off before anything is learned."),
      table.number("current_m_s", &CalibrationSettings::current_m_s, kMetresPerSecond, 0, 10,
                   "Expected water current, one standard deviation of each axis."),
      table.number("advance_m", &CalibrationSettings::advance_m, kMetres, 0, 10,
                   "Distance through the water for one revolution of the shaft, straight ahead; 0 if unknown "
                   "(then the compass is not calibrated by GPS)."),
  };
  for (const auto& [key, name] : kOlderNames) {
    for (auto& option : instrument_options()) {
      if (option.name() != name) continue;
      option.table = "calibration";
      option.key = key;
      option.moved_to = name;
      options.push_back(std::move(option));
    }
  }
  return options;
}

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
