// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "validation/reference/parameter_deviations.h"

namespace navcal::reference {

/// From the commanded angles to those of the fins: servo (first-order lag, reported), gain, further first-order
/// lag, backlash, offset. Between two commands both lags have a solution in closed form, so no integrator touches
/// them:
///     s(t) = c + (s0 - c) exp(-t/T)
///     x(t) = c + (x0 - c) exp(-t/tau) + (s0 - c) (exp(-t/T) - exp(-t/tau)) T / (T - tau)
/// Radians, seconds; rudder and elevator mix into the fins as the motor card has it (ICD section 4).
class FinLinkage {
 public:
  FinLinkage(double servo_time_s, const VehicleDeviations& deviations)
      : servo_time_s_(servo_time_s), lag_s_(deviations.fin_lag_s), backlash_rad_(deviations.fin_backlash_rad),
        gain_(1 + deviations.fin_gain), offset_rad_(mixed(deviations.rudder_rad, deviations.elevator_rad)) {}

  [[nodiscard]] static Vector3 mixed(double rudder_rad, double elevator_rad) {
    const double half_root_3 = std::sqrt(0.75);
    return {-rudder_rad, rudder_rad / 2 + elevator_rad * half_root_3, rudder_rad / 2 - elevator_rad * half_root_3};
  }

  void command(const Vector3& angles_rad) { command_rad_ = angles_rad.cwiseMax(-kLimit_rad).cwiseMin(kLimit_rad); }
  /// The servos stand there at once: for a drive by recorded angles.
  void hold(const Vector3& angles_rad) {
    command_rad_ = servo_rad_ = angles_rad;
    if (!held_) lagged_rad_ = gain_ * angles_rad;  // a low-pass begins at its first input
    held_ = true;
  }

  /// The servo angles that the card reports, `after_s` from the last settle().
  [[nodiscard]] Vector3 servos_rad(double after_s) const {
    return command_rad_ + std::exp(-after_s / servo_time_s_) * (servo_rad_ - command_rad_);
  }
  [[nodiscard]] Vector3 fins_rad(double after_s) const {
    return within_backlash(lagged_rad(after_s)) + offset_rad_;
  }

  /// Takes the present as the new beginning; backlash remembers it.
  void settle(double after_s) {
    const Vector3 lagged = lagged_rad(after_s);
    seat_rad_ = within_backlash(lagged);
    servo_rad_ = servos_rad(after_s);
    lagged_rad_ = lagged;
  }

 private:
  static constexpr double kLimit_rad = 25 * 0.017453292519943295;

  /// Shafts behind gain and lag, angles of the servos times the gain.
  [[nodiscard]] Vector3 lagged_rad(double after_s) const {
    if (lag_s_ <= 0) return gain_ * servos_rad(after_s);
    const double servo = std::exp(-after_s / servo_time_s_), lag = std::exp(-after_s / lag_s_);
    const double difference = after_s / lag_s_ - after_s / servo_time_s_;
    const double mean = std::abs(difference) < 1e-9 ? 1 : -std::expm1(-difference) / difference;
    return gain_ * command_rad_ + lag * (lagged_rad_ - gain_ * command_rad_) +
           (after_s / lag_s_ * servo * mean) * gain_ * (servo_rad_ - command_rad_);
  }
  [[nodiscard]] Vector3 within_backlash(const Vector3& driven_rad) const {
    const Vector3 half = Vector3::Constant(backlash_rad_ / 2);
    return seat_rad_.cwiseMax(driven_rad - half).cwiseMin(driven_rad + half);
  }

  double servo_time_s_, lag_s_, backlash_rad_, gain_;
  Vector3 offset_rad_;
  Vector3 command_rad_ = Vector3::Zero();
  Vector3 servo_rad_ = Vector3::Zero();
  Vector3 lagged_rad_ = Vector3::Zero();
  Vector3 seat_rad_ = Vector3::Zero();
  bool held_ = false;
};

}  // namespace navcal::reference
