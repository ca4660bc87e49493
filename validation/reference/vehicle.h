// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "validation/reference/fin_linkage.h"
#include "validation/reference/forces.h"
#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/snapshot.h"

namespace navcal::reference {

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
