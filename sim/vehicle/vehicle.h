// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "config/vehicle.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/fin_forces.h"
#include "sim/vehicle/hull_forces.h"
#include "sim/vehicle/influences.h"
#include "sim/vehicle/propeller.h"

namespace navcal::sim {

/// The motion left what the model can describe; what() says when and in which state.
class UnstableVehicle : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Actuator positions that are held constant during a step.
struct Controls {
  Eigen::Vector3d fins_rad = Eigen::Vector3d::Zero();
  double shaft_rps = 0;
};

/// A neutrally buoyant vehicle in six degrees of freedom (Fossen 2011, chapters 2, 3, 6 and 7), nu = (u, v, w, p,
/// q, r) in body axes about the centre of buoyancy, eta = position and Euler angles in the world's:
///   M nu' + C(nu) nu = tau(nu, eta, controls),   eta' = J(eta) nu + current.
/// C is that of the whole M, rigid body and water, so the Munk moment is in it; with p_1 = (M nu)_linear and
/// p_2 = (M nu)_angular, C nu = (omega x p_1, omega x p_2 + v x p_1), which does no work. tau: hull, fins,
/// propeller, restoring moment, linear damping, and what effects add.
class Vehicle {
 public:
  explicit Vehicle(const config::VehicleSettings& settings);

  struct Step {
    Body body;             ///< at its end
    Vector6 acceleration;  ///< nu' at its beginning
  };
  /// One step of the classical Runge-Kutta method of fourth order.
  [[nodiscard]] Step step(const Body& body, const Controls& held, const Influences& influences,
                          double step_s) const;
  /// The body after one step of the midpoint rule, of second order: for an estimator, whose next reading corrects
  /// more than what this leaves out. Controls are means over the step's first half and over all of it: of the
  /// latter alone it would not tell when in the step a fin moved.
  [[nodiscard]] Body midpoint_step(const Body& body, const Controls& first_half, const Controls& all,
                                   const Influences& influences, double step_s) const;
  /// nu' at this instant.
  [[nodiscard]] Vector6 acceleration(const Body& body, const Controls& held, const Influences& influences) const {
    return change(body, held, influences).velocity;
  }
  [[nodiscard]] const Matrix6& mass() const { return mass_; }

 private:
  struct Change {
    Eigen::Vector3d position_m_s, euler_rad_s;
    Vector6 velocity;
  };
  [[nodiscard]] Change change(const Body& body, const Controls& held, const Influences& influences) const;
  [[nodiscard]] static Body moved(const Body& body, const Change& by, double time_s) {
    return {body.position_m + time_s * by.position_m_s, body.euler_rad + time_s * by.euler_rad_s,
            body.velocity + time_s * by.velocity};
  }

  Matrix6 mass_;
  Matrix6 mass_inverse_;
  HullForces hull_;
  FinForces fins_;
  Propeller propeller_;
  double restoring_Nm_;           ///< m g zg
  Eigen::Vector3d damping_Nm_s_;  ///< about x, y, z
};

/// Throws UnstableVehicle when the state is not finite, faster than anything of this size moves, or stands on its
/// nose, where Euler angles end.
void check_stable(const Body& body, double time_s);

}  // namespace navcal::sim
