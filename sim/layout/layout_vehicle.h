// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "config/layout.h"
#include "sim/layout/actuator_forces.h"
#include "sim/layout/actuators.h"
#include "sim/layout/damping.h"
#include "sim/layout/restoring.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/influences.h"

namespace navcal::sim {

/// The vehicle of a layout in six degrees of freedom (Fossen 2011, equations 7.240 and 7.241), nu = (u, v, w, p,
/// q, r) in body axes about the layout's origin, eta = position and Euler angles in north, east, down:
///   M nu' + C(nu) nu = tau(nu, eta, actuators),   eta' = J(eta) nu + current,   M = M_RB + M_A.
/// C is that of the whole M, so the Munk moment is in it: with p_1 = (M nu)_linear and p_2 = (M nu)_angular,
/// C nu = (omega x p_1, omega x p_2 + v x p_1), which does no work. tau: hull, surfaces, thrusters, weight and
/// buoyancy, and what effects add. M follows the moving masses; the momentum that they carry while they move is
/// neglected.
class LayoutVehicle {
  struct MassMatrix {
    Matrix6 mass, inverse;
  };

 public:
  explicit LayoutVehicle(config::Layout layout);

  /// Input of a step: actuators that are held, with mass matrix and restoring forces for them. Other forces at
  /// rest may be added. The vehicle must outlive it.
  class Held {
    std::optional<MassMatrix> moved_;  ///< where masses move; else that of the vehicle

   public:
    Held(const LayoutVehicle& vehicle, const ActuatorValues& at, const Influences& on);
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

    const Matrix6 &mass, &mass_inverse;
    Restoring restoring;
    ActuatorValues actuators;
    Influences influences;
  };
  [[nodiscard]] Held hold(const ActuatorValues& actuators, const Influences& influences = {}) const {
    return {*this, actuators, influences};
  }

  struct Step {
    Body body;             ///< at its end
    Vector6 acceleration;  ///< nu' at its beginning
  };
  /// One step of the classical Runge-Kutta method of fourth order with actuators that are held.
  [[nodiscard]] Step step(const Body& body, const ActuatorValues& actuators, double step_s,
                          const Influences& influences = {}) const {
    return held_step(body, hold(actuators, influences), step_s);
  }
  /// The same with what hold() gave.
  [[nodiscard]] Step held_step(const Body& body, const Held& held, double step_s) const {
    return moved_step(body, held, held, held, step_s);
  }
  /// The same with actuators that move: at the step's begin, middle and end.
  [[nodiscard]] Step moved_step(const Body& body, const Held& begin, const Held& middle, const Held& end,
                                double step_s) const;
  /// The body after one step of the midpoint rule, of second order: for an estimator, whose next reading corrects
  /// more than what this leaves out. Actuators are means over the step's first half and over all of it: of the
  /// latter alone it would not tell when in the step a fin moved.
  [[nodiscard]] Body midpoint_step(const Body& body, const ActuatorValues& first_half, const ActuatorValues& all,
                                   double step_s, const Influences& influences = {}) const;

  /// tau - C nu about the origin, N and Nm, at this body velocity with `down` in body axes.
  [[nodiscard]] Vector6 force(const Vector6& velocity, const Eigen::Vector3d& down, const Held& held) const;
  /// nu' at this instant.
  [[nodiscard]] Vector6 acceleration(const Body& body, const Held& held) const {
    return held.mass_inverse * force(body.velocity, down_of(body.euler_rad), held);
  }

  [[nodiscard]] const config::Layout& layout() const { return layout_; }
  /// M while the moving masses are at zero.
  [[nodiscard]] const Matrix6& mass() const { return at_zero_.mass; }

 private:
  struct Change {
    Eigen::Vector3d position_m_s, euler_rad_s;
    Vector6 velocity;
  };
  [[nodiscard]] MassMatrix mass_matrix(const ActuatorNumbers& masses_m) const;
  [[nodiscard]] Change change(const Body& body, const Held& held) const;
  [[nodiscard]] static Body moved(const Body& body, const Change& by, double time_s) {
    return {body.position_m + time_s * by.position_m_s, body.euler_rad + time_s * by.euler_rad_s,
            body.velocity + time_s * by.velocity};
  }

  config::Layout layout_;
  Matrix6 added_mass_;
  MassMatrix at_zero_;           ///< with moving masses at zero
  Restoring restoring_at_zero_;  ///< with ballasts and moving masses at zero
  HullDamping hull_;
  std::vector<ThrusterForce> thrusters_;
  std::vector<SurfaceForce> surfaces_;
};

/// Follows commands: actuators with their lags and rates, whose mean over a step the vehicle feels.
class LayoutRun {
 public:
  LayoutRun(const LayoutVehicle& vehicle, const Body& body);
  LayoutRun(const LayoutVehicle& vehicle, const Body& body, ActuatorValues positions);

  /// Takes steps of 0.01 s to the nearest whole number of them. Throws UnstableVehicle.
  void advance(const ActuatorValues& commands, double seconds);
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const ActuatorValues& positions() const { return positions_; }
  [[nodiscard]] double time_s() const { return time_s_; }

 private:
  const LayoutVehicle& vehicle_;
  Body body_;
  ActuatorValues positions_;
  double time_s_ = 0;
};

}  // namespace navcal::sim
