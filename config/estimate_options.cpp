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
      compass.number("compass_field_noise_uT", &CompassAccuracy::field_noise_uT, kMicrotesla, 0.001, 20),
      compass.number("compass_tilt_noise_deg", &CompassAccuracy::tilt_noise_rad, kDegrees, 0.001, 20),
      compass.number("compass_tilt_lag_s", &CompassAccuracy::tilt_lag_s, kSeconds, 0, 10),
      compass.number("compass_temperature_noise_C", &CompassAccuracy::temperature_noise_C, kCelsius, 0, 20),
      imu.number("imu_gyro_noise_deg_s", &ImuAccuracy::gyro_noise_rad_s, kDegreesPerSecond, 0.0001, 20),
      imu.number("imu_turn_on_bias_deg_s", &ImuAccuracy::turn_on_bias_rad_s, kDegreesPerSecond, 0.0001, 20),
      imu.number("imu_force_noise_m_s2", &ImuAccuracy::force_noise_m_s2, kMetresPerSecondSquared, 0.0001, 10),
      imu.number("imu_depth_noise_m", &ImuAccuracy::depth_noise_m, kMetres, 0.0001, 10),
      gps.number("gps_position_noise_m", &GpsAccuracy::position_noise_m, kMetres, 0.001, 100),
      gps.number("gps_velocity_noise_m_s", &GpsAccuracy::velocity_noise_m_s, kMetresPerSecond, 0.001, 10),
      gps.number("gps_antenna_depth_m", &GpsAccuracy::antenna_depth_m, kMetres, 0, 100),
      gps.number("gps_least_search_s", &GpsAccuracy::least_search_s, kSeconds, 0, 3600),
      gps.number("gps_longest_search_s", &GpsAccuracy::longest_search_s, kSeconds, 0, 3600),
      gps.choice("gps_search_model", &GpsAccuracy::search_model, {"uniform", "receiver-state"}),
      gps.number("gps_hot_start_s", &GpsAccuracy::hot_start_s, kSeconds, 0, 3600),
      gps.number("gps_warm_start_s", &GpsAccuracy::warm_start_s, kSeconds, 0, 3600),
      gps.number("gps_cold_start_s", &GpsAccuracy::cold_start_s, kSeconds, 0, 3600),
      gps.number("gps_ephemeris_life_s", &GpsAccuracy::ephemeris_life_s, kSeconds, 1, 86400),
      motor.number("motor_fin_noise_deg", &MotorAccuracy::fin_noise_rad, kDegrees, 0, 20),
      motor.number("motor_current_noise_A", &MotorAccuracy::current_noise_A, kAmperes, 0, 100),
  };
}

std::vector<Option<Settings>> calibration_options() {
  const auto table = table_of<Settings>("calibration", &Settings::calibration);
  std::vector<Option<Settings>> options{
      table.boolean("enabled", &CalibrationSettings::enabled),
      table.boolean("automatic", &CalibrationSettings::automatic),
      table.number("margin_percent", &CalibrationSettings::margin, kPercent, 0, 90),
      table.number("motor_settle_s", &CalibrationSettings::motor_settle_s, kSeconds, 0, 60),
      table.number("heading_noise_deg", &CalibrationSettings::heading_noise_rad, kDegrees, 0, 20),
      table.number("field_noise_uT", &CalibrationSettings::field_noise_uT, kMicrotesla, 0, 20),
      table.number("bias_walk_deg_s", &CalibrationSettings::bias_walk_rad_s, kDegreesPerSecond, 0, 10),
      table.number("compass_delay_ms", &CalibrationSettings::compass_delay_s, kMilliseconds, 0, 1900),
      table.number("current_m_s", &CalibrationSettings::current_m_s, kMetresPerSecond, 0, 10),
      table.number("advance_m", &CalibrationSettings::advance_m, kMetres, 0, 10),
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
      table.boolean("enabled", &NavigationSettings::enabled),
      table.number("interval_s", &NavigationSettings::interval_s, kSeconds, 0.05, 60),
      table.number("heading_error_deg", &NavigationSettings::heading_error_rad, kDegrees, 0, 90),
      table.number("heading_error_calibrated_deg", &NavigationSettings::heading_error_calibrated_rad, kDegrees, 0,
                   90),
      table.number("speed_error_percent", &NavigationSettings::speed_error, kPercent, 0, 100),
      table.number("speed_lag_s", &NavigationSettings::speed_lag_s, kSeconds, 0, 60),
      table.number("dvl_noise_m_s", &NavigationSettings::dvl_noise_m_s, kMetresPerSecond, 0.0001, 1),
      table.number("dvl_scale_error_percent", &NavigationSettings::dvl_scale_error, kPercent, 0, 100),
      table.number("dvl_alignment_error_deg", &NavigationSettings::dvl_alignment_error_rad, kDegrees, 0, 90),
      table.number("water_density_kg_m3", &NavigationSettings::water_density_kg_m3, kKilogramsPerCubicMetre, 900,
                   1300),
      table.number("air_pressure_hPa", &NavigationSettings::air_pressure_Pa, kHectopascals, 500, 1200),
      table.number("max_error_m", &NavigationSettings::max_error_m, kMetres, 0, 100000),
      table.number("altitude_noise_m", &NavigationSettings::altitude_noise_m, kMetres, 0.001, 100),
      table.number("altimeter_range_m", &NavigationSettings::altimeter_range_m, kMetres, 0.1, 12000),
      table.number("min_altitude_m", &NavigationSettings::min_altitude_m, kMetres, 0, 1000),
      table.number("floor_warning_s", &NavigationSettings::floor_warning_s, kSeconds, 0, 60),
  };
}

}  // namespace navcal::config
