// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"

namespace navcal::config {

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

}  // namespace navcal::config
