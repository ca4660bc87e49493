// SPDX-License-Identifier: Apache-2.0
#include "config/calibration_options.h"

namespace navcal::config {

std::vector<Option<Settings>> calibration_options() {
  using S = Settings;
  const NumberOf<S> number{"calibration"};
  return {
      boolean<S>(
          {.table = "calibration", .key = "enabled", .description = "Whether the calibrators run at all."},
          [](auto& s) -> auto& { return s.calibration.enabled; }),
      boolean<S>(
          {.table = "calibration",
           .key = "automatic",
           .description = "Whether estimates become active by themselves; otherwise only by calibration.accept."},
          [](auto& s) -> auto& { return s.calibration.automatic; }),
      number(
          "margin_percent", "Improvement on held-out readings that an estimate needs to become active by itself.",
          kPercent, 0, 90, [](auto& s) -> auto& { return s.calibration.margin; }),
      number(
          "motor_settle_s", "Time after a switching of the motor during which magnetic readings are left out.",
          kSeconds, 0, 60, [](auto& s) -> auto& { return s.calibration.motor_settle_s; }),
      number(
          "heading_noise_deg",
          "Noise of the compass's heading that the calibrators reckon with, one standard deviation of a reading; "
          "0: it follows from the compass in [instruments] (0.5 deg for the reference one).",
          kDegrees, 0, 20, [](auto& s) -> auto& { return s.calibration.heading_noise_rad; }),
      real<S>(
          {.table = "calibration",
           .key = "gyro_noise_deg_s",
           .description = "Older name of instruments.imu_gyro_noise_deg_s.",
           .unit = kDegreesPerSecond,
           .low = 0.0001,
           .high = 20,
           .moved_to = "instruments.imu_gyro_noise_deg_s"},
          [](auto& s) -> auto& { return s.instruments.imu.gyro_noise_rad_s; }),
      number(
          "field_noise_uT",
          "Noise of each axis of the magnetic field that the calibrators reckon with; 0: it follows from the "
          "compass in [instruments] (0.2 uT for the reference one).",
          kMicrotesla, 0, 20, [](auto& s) -> auto& { return s.calibration.field_noise_uT; }),
      number(
          "bias_walk_deg_s",
          "Random walk of a gyro's bias in one second (grows with the root of time), one standard deviation.",
          kDegreesPerSecond, 0, 10, [](auto& s) -> auto& { return s.calibration.bias_walk_rad_s; }),
      real<S>(
          {.table = "calibration",
           .key = "tilt_lag_s",
           .description = "Older name of instruments.compass_tilt_lag_s.",
           .unit = kSeconds,
           .low = 0,
           .high = 10,
           .moved_to = "instruments.compass_tilt_lag_s"},
          [](auto& s) -> auto& { return s.instruments.compass.tilt_lag_s; }),
      real<S>(
          {.table = "calibration",
           .key = "position_noise_m",
           .description = "Older name of instruments.gps_position_noise_m.",
           .unit = kMetres,
           .low = 0.001,
           .high = 100,
           .moved_to = "instruments.gps_position_noise_m"},
          [](auto& s) -> auto& { return s.instruments.gps.position_noise_m; }),
      real<S>(
          {.table = "calibration",
           .key = "velocity_noise_m_s",
           .description = "Older name of instruments.gps_velocity_noise_m_s.",
           .unit = kMetresPerSecond,
           .low = 0.001,
           .high = 10,
           .moved_to = "instruments.gps_velocity_noise_m_s"},
          [](auto& s) -> auto& { return s.instruments.gps.velocity_noise_m_s; }),
      number(
          "current_m_s", "Expected water current, one standard deviation of each axis.", kMetresPerSecond, 0, 10,
          [](auto& s) -> auto& { return s.calibration.current_m_s; }),
      number(
          "advance_m",
          "Distance through the water for one revolution of the shaft, straight ahead; 0 if unknown (then the "
          "compass is not calibrated by GPS).",
          kMetres, 0, 10, [](auto& s) -> auto& { return s.calibration.advance_m; }),
  };
}

}  // namespace navcal::config
