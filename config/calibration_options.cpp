// SPDX-License-Identifier: Apache-2.0
#include "config/calibration_options.h"

namespace navcal::config {

std::vector<Option<Settings>> calibration_options() {
  using S = Settings;
  return {
      boolean<S>(
          {.table = "calibration", .key = "enabled", .description = "Whether the calibrators run at all."},
          [](auto& s) -> auto& { return s.calibration.enabled; }),
      boolean<S>(
          {.table = "calibration",
           .key = "automatic",
           .description = "Whether estimates become active by themselves; otherwise only by calibration.accept."},
          [](auto& s) -> auto& { return s.calibration.automatic; }),
      real<S>(
          {.table = "calibration",
           .key = "margin_percent",
           .description = "Improvement on held-out readings that an estimate needs to become active by itself.",
           .unit = kPercent,
           .low = 0,
           .high = 90},
          [](auto& s) -> auto& { return s.calibration.margin; }),
      real<S>(
          {.table = "calibration",
           .key = "motor_settle_s",
           .description = "Time after a switching of the motor during which magnetic readings are left out.",
           .unit = kSeconds,
           .low = 0,
           .high = 60},
          [](auto& s) -> auto& { return s.calibration.motor_settle_s; }),
      real<S>(
          {.table = "calibration",
           .key = "heading_noise_deg",
           .description = "Noise of the compass's heading, one standard deviation of a reading.",
           .unit = kDegrees,
           .low = 0.01,
           .high = 20},
          [](auto& s) -> auto& { return s.calibration.heading_noise_rad; }),
      real<S>(
          {.table = "calibration",
           .key = "gyro_noise_deg_s",
           .description = "Noise of the gyros' rates, one standard deviation of a reading.",
           .unit = kDegreesPerSecond,
           .low = 0.0001,
           .high = 20},
          [](auto& s) -> auto& { return s.calibration.gyro_noise_rad_s; }),
      real<S>(
          {.table = "calibration",
           .key = "field_noise_uT",
           .description = "Noise of each axis of the magnetic field, one standard deviation of a reading.",
           .unit = kMicrotesla,
           .low = 0.001,
           .high = 20},
          [](auto& s) -> auto& { return s.calibration.field_noise_uT; }),
      real<S>(
          {.table = "calibration",
           .key = "bias_walk_deg_s",
           .description = "Random walk of a gyro's bias in one second (grows with the root of time), one "
                          "standard deviation.",
           .unit = kDegreesPerSecond,
           .low = 0,
           .high = 10},
          [](auto& s) -> auto& { return s.calibration.bias_walk_rad_s; }),
      real<S>(
          {.table = "calibration",
           .key = "tilt_lag_s",
           .description = "First-order lag of the compass's inclinometer; 0 if it has none.",
           .unit = kSeconds,
           .low = 0,
           .high = 10},
          [](auto& s) -> auto& { return s.calibration.tilt_lag_s; }),
      real<S>(
          {.table = "calibration",
           .key = "position_noise_m",
           .description = "Noise of a position fix, each axis.",
           .unit = kMetres,
           .low = 0.001,
           .high = 100},
          [](auto& s) -> auto& { return s.calibration.position_noise_m; }),
      real<S>(
          {.table = "calibration",
           .key = "velocity_noise_m_s",
           .description = "Noise of the receiver's velocity, each axis.",
           .unit = kMetresPerSecond,
           .low = 0.001,
           .high = 10},
          [](auto& s) -> auto& { return s.calibration.velocity_noise_m_s; }),
      real<S>(
          {.table = "calibration",
           .key = "current_m_s",
           .description = "Expected water current, one standard deviation of each axis.",
           .unit = kMetresPerSecond,
           .low = 0,
           .high = 10},
          [](auto& s) -> auto& { return s.calibration.current_m_s; }),
      real<S>(
          {.table = "calibration",
           .key = "advance_m",
           .description = "Distance through the water for one revolution of the shaft, straight ahead; 0 if "
                          "unknown (then the compass is not calibrated by GPS).",
           .unit = kMetres,
           .low = 0,
           .high = 10},
          [](auto& s) -> auto& { return s.calibration.advance_m; }),
  };
}

}  // namespace navcal::config
