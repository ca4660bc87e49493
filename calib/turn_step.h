#pragma once

namespace navcal::calib {

/// What gyro and tilt say of the turn from one compass reading to the next, in the regressors of THESIS 11.7:
///   psi(end) - psi(begin) = scale * measured_angle + bias * bias_time + tilt_angle
/// where true rate = scale * measured + bias (2.12) and psi is the true heading, clockwise, radians.
struct TurnStep {
  double time_s = 0;           ///< of the compass reading at the end
  double heading_rad = 0;      ///< that reading, as measured
  bool begins_segment = true;  ///< nothing is known of the turn before this reading; the rest is then zero
  double duration_s = 0;       ///< since the reading before
  double measured_angle_rad =
      0;  ///< S1: integral of F times gyro A's measured yaw rate, F = 1/(cos roll cos pitch)
  double measured_angle_b_rad = 0;  ///< the same of gyro B
  double bias_time_s = 0;           ///< S2: integral of F
  double tilt_angle_rad = 0;        ///< T: integral of tan(roll)/cos(pitch) d(pitch)

  /// The same step as gyro B saw it.
  [[nodiscard]] TurnStep with_gyro_b() const {
    TurnStep step = *this;
    step.measured_angle_rad = measured_angle_b_rad;
    return step;
  }
};

}  // namespace navcal::calib
