// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "validation/reference/forces.h"
#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/snapshot.h"

namespace navcal::reference {

/// y(t + h) of y' = slope(t, y) by the fifth-order formula of Dormand and Prince (J. Comp. Appl. Math. 6, 1980),
/// six slopes a step; what it leaves out is of the order h^6 a step. The step is the caller's: events (a new
/// command) lie on the ends of steps, and the same steps give the same bits.
template <class State, class Slope>
[[nodiscard]] State dormand_prince(double t, const State& y, double h, const Slope& slope) {
  const State k1 = slope(t, y);
  const State k2 = slope(t + h / 5, State(y + h * (1.0 / 5) * k1));
  const State k3 = slope(t + h * 3 / 10, State(y + h * (3.0 / 40 * k1 + 9.0 / 40 * k2)));
  const State k4 = slope(t + h * 4 / 5, State(y + h * (44.0 / 45 * k1 - 56.0 / 15 * k2 + 32.0 / 9 * k3)));
  const State k5 =
      slope(t + h * 8 / 9,
            State(y + h * (19372.0 / 6561 * k1 - 25360.0 / 2187 * k2 + 64448.0 / 6561 * k3 - 212.0 / 729 * k4)));
  const State k6 = slope(t + h, State(y + h * (9017.0 / 3168 * k1 - 355.0 / 33 * k2 + 46732.0 / 5247 * k3 +
                                               49.0 / 176 * k4 - 5103.0 / 18656 * k5)));
  return y + h * (35.0 / 384 * k1 + 500.0 / 1113 * k3 + 125.0 / 192 * k4 - 2187.0 / 6784 * k5 + 11.0 / 84 * k6);
}

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

/// Initial state of a vehicle.
struct Start {
  Vector3 position_m = Vector3::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Vector3 velocity_m_s = Vector3::Zero();
  Vector3 rate_rad_s = Vector3::Zero();
  double shaft_rev_s = 0;
};

/// Kirchhoff's equations of a body in water (Lamb, Hydrodynamics, ch. 6; Leonard, Automatica 33, 1997), by the
/// momenta P, H of the body and the water that it carries, body axes at the centre of buoyancy:
///     P' = P x omega + force        H' = H x omega + P x v + moment        (P, H) = M (v, omega)
///     x' = R v + current            q' = 1/2 q (0, omega)
/// Attitude is a unit quaternion. Steps of at most 4 ms by Dormand and Prince, never across a command.
class Vehicle {
 public:
  static constexpr double kStep_s = 0.004;

  /// `longest_step_s`: for measuring the order of the integrator.
  Vehicle(const Hull& hull, const VehicleDeviations& deviations, const Start& start,
          double longest_step_s = kStep_s);

  /// From now on; servos and shaft follow by their lags.
  void command(double shaft_rev_s, const Vector3& fins_rad);
  /// Servos and shaft stand there at once and stay: a drive by what was recorded.
  void hold(double shaft_rev_s, const Vector3& fins_rad);

  /// In equal steps, as few as may be.
  void advance(double to_s);

  [[nodiscard]] Snapshot snapshot() const;
  /// Energy of body and carried water, with the potential energy of the low centre of gravity; constant without
  /// drive and damping.
  [[nodiscard]] double energy_J() const;
  [[nodiscard]] bool finite() const;
  [[nodiscard]] double time_s() const { return time_s_; }

 private:
  /// Position, quaternion (x, y, z, w), P, H.
  using Coordinates = Eigen::Matrix<double, 13, 1>;

  [[nodiscard]] Coordinates slope(double after_s, const Coordinates& y) const;
  [[nodiscard]] Wrench wrench(double after_s, const Coordinates& y, const Flow& flow, const Vector3& down) const;
  [[nodiscard]] Flow flow_of(const Coordinates& y) const;
  [[nodiscard]] Eigen::Vector2d current_m_s(double time_s) const;
  [[nodiscard]] double shaft_rev_s(double after_s) const;
  void step(double length_s);

  Hull hull_;
  VehicleDeviations departures_;
  Matrix6 inertia_, inverse_inertia_;
  double longest_step_s_;
  FinLinkage fins_;
  double time_s_ = 0;  ///< at the beginning of the step
  Coordinates y_ = Coordinates::Zero();
  double shaft_rev_s_, shaft_command_rev_s_;
  double charge_C_ = 0;  ///< taken from the battery
};

/// Current of the propulsion motor.
[[nodiscard]] double motor_current_A(double shaft_rev_s);

}  // namespace navcal::reference
