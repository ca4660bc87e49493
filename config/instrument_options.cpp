// SPDX-License-Identifier: Apache-2.0
#include "config/instrument_options.h"

namespace navcal::config {

std::vector<Option<Settings>> instrument_options() {
  using S = Settings;
  const NumberOf<S> number{"instruments"};
  return {
      number(
          "compass_field_noise_uT", "Noise of each axis of the compass's field.", kMicrotesla, 0.001, 20,
          [](auto& s) -> auto& { return s.instruments.compass.field_noise_uT; }),
      number(
          "compass_tilt_noise_deg", "Noise of the inclinometer's roll and pitch.", kDegrees, 0.001, 20,
          [](auto& s) -> auto& { return s.instruments.compass.tilt_noise_rad; }),
      number(
          "compass_tilt_lag_s", "First-order lag of the inclinometer; 0 when it has none.", kSeconds, 0, 10,
          [](auto& s) -> auto& { return s.instruments.compass.tilt_lag_s; }),
      number(
          "compass_temperature_noise_C", "Noise of the compass's thermometer.", kCelsius, 0, 20,
          [](auto& s) -> auto& { return s.instruments.compass.temperature_noise_C; }),
      number(
          "imu_gyro_noise_deg_s", "Noise of each gyro's rate.", kDegreesPerSecond, 0.0001, 20,
          [](auto& s) -> auto& { return s.instruments.imu.gyro_noise_rad_s; }),
      number(
          "imu_turn_on_bias_deg_s", "Bias of each gyro, new at each power-on.", kDegreesPerSecond, 0.0001, 20,
          [](auto& s) -> auto& { return s.instruments.imu.turn_on_bias_rad_s; }),
      number(
          "imu_force_noise_m_s2", "Noise of each accelerometer.", kMetresPerSecondSquared, 0.0001, 10,
          [](auto& s) -> auto& { return s.instruments.imu.force_noise_m_s2; }),
      number(
          "imu_depth_noise_m", "Noise of the depth gauge.", kMetres, 0.0001, 10,
          [](auto& s) -> auto& { return s.instruments.imu.depth_noise_m; }),
      number(
          "gps_position_noise_m", "Noise of a position fix, each axis.", kMetres, 0.001, 100,
          [](auto& s) -> auto& { return s.instruments.gps.position_noise_m; }),
      number(
          "gps_velocity_noise_m_s", "Noise of the receiver's velocity, each axis.", kMetresPerSecond, 0.001, 10,
          [](auto& s) -> auto& { return s.instruments.gps.velocity_noise_m_s; }),
      number(
          "gps_antenna_depth_m", "The receiver has no fixes while the vehicle's origin is deeper than this.",
          kMetres, 0, 100, [](auto& s) -> auto& { return s.instruments.gps.antenna_depth_m; }),
      number(
          "gps_least_search_s", "Shortest time from sight of the sky to the first fix.", kSeconds, 0, 3600,
          [](auto& s) -> auto& { return s.instruments.gps.least_search_s; }),
      number(
          "gps_longest_search_s", "Longest such time; not less than the shortest.", kSeconds, 0, 3600,
          [](auto& s) -> auto& { return s.instruments.gps.longest_search_s; }),
      choice<S>(
          {.table = "instruments",
           .key = "gps_search_model",
           .description = "Model of the search: uniform between these two times, or by what the receiver still "
                          "knows (receiver-state).",
           .choices = {"uniform", "receiver-state"}},
          [](auto& s) -> auto& { return s.instruments.gps.search_model; }),
      number(
          "gps_hot_start_s", "Mean search with valid ephemerides (receiver-state).", kSeconds, 0, 3600,
          [](auto& s) -> auto& { return s.instruments.gps.hot_start_s; }),
      number(
          "gps_warm_start_s", "Mean search with time and position, without ephemerides (receiver-state).",
          kSeconds, 0, 3600, [](auto& s) -> auto& { return s.instruments.gps.warm_start_s; }),
      number(
          "gps_cold_start_s", "Mean search without time or position (receiver-state).", kSeconds, 0, 3600,
          [](auto& s) -> auto& { return s.instruments.gps.cold_start_s; }),
      number(
          "gps_ephemeris_life_s", "Longest life of an ephemeris without reception; the shortest is half of it.",
          kSeconds, 1, 86400, [](auto& s) -> auto& { return s.instruments.gps.ephemeris_life_s; }),
      number(
          "motor_fin_noise_deg", "Noise of the fin angles that the motor card reports.", kDegrees, 0, 20,
          [](auto& s) -> auto& { return s.instruments.motor.fin_noise_rad; }),
      number(
          "motor_current_noise_A", "Noise of the motor's current.", kAmperes, 0, 100,
          [](auto& s) -> auto& { return s.instruments.motor.current_noise_A; }),
  };
}

}  // namespace navcal::config
