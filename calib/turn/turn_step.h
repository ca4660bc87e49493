// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/archive.h"

namespace navcal::calib {

/// Turn from one compass reading to the next by gyro and tilt, in the regressors of THESIS 11.7:
///   psi(end) - psi(begin) = scale * measured_angle + bias * bias_time + tilt_angle
/// where true rate = scale * measured + bias (2.12) and psi is the true heading, clockwise, radians.
struct TurnStep {
  double time_s = 0;           ///< of the compass reading at the end
  double heading_rad = 0;      ///< that reading, as measured but for the tilt, which is corrected for its lag
  bool begins_segment = true;  ///< nothing is known of the turn before this reading; the rest is then zero
  double duration_s = 0;       ///< since the reading before
  double measured_angle_rad =
      0;  ///< S1: integral of F times gyro A's measured yaw rate, F = 1/(cos roll cos pitch)
  double measured_angle_b_rad = 0;     ///< the same of gyro B; NaN without one
  double bias_time_s = 0;              ///< S2: integral of F
  double tilt_angle_rad = 0;           ///< T: integral of tan(roll)/cos(pitch) d(pitch)
  double roll_rad = 0, pitch_rad = 0;  ///< at the reading, without the inclinometer's lag
  bool tilt_restored = false;  ///< by the gyros, from an inclinometer that lags; else roll and pitch are as shown
  double roll_lag_rad = 0, pitch_lag_rad = 0;  ///< these less what the inclinometer shows, without its noise

  /// The same step with gyro B's angle in place of gyro A's.
  [[nodiscard]] TurnStep with_gyro_b() const {
    TurnStep step = *this;
    step.measured_angle_rad = measured_angle_b_rad;
    return step;
  }
  void archive(Archive& archive) {
    archive(time_s, heading_rad, begins_segment, duration_s, measured_angle_rad, measured_angle_b_rad, bias_time_s,
            tilt_angle_rad, roll_rad, pitch_rad, tilt_restored, roll_lag_rad, pitch_lag_rad);
  }
};

}  // namespace navcal::calib
