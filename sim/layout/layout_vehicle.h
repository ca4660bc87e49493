// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "autopilot/thrust_curve.h"
#include "config/layout.h"
#include "sim/layout/actuators.h"
#include "sim/layout/mass_matrix.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/influences.h"

namespace navcal::sim {

/// Weight and buoyancy (Fossen 2011, chapter 4). With d the unit vector downwards in body axes, W the weight at
/// r_g, B the buoyancy at r_b and b_i the buoyancy that ballast i adds at r_i:
///   force = (W - B - sum b_i) d,   moment = (W r_g - B r_b - sum b_i r_i) x d.
struct Restoring {
  double net_weight_N = 0;   ///< W - B - sum b_i
  Eigen::Vector3d arm_Nm{};  ///< W r_g - B r_b - sum b_i r_i

  void add(const Eigen::Vector3d& down, Vector6& force) const {
    force.head<3>() += net_weight_N * down;
    force.tail<3>() += arm_Nm.cross(down);
  }
};

/// Ballasts at these added buoyancies (N), moving masses at these places along their axes (m).
[[nodiscard]] Restoring restoring_of(const config::Layout& layout, const ActuatorNumbers& ballasts_N,
                                     const ActuatorNumbers& masses_m);

/// Downwards in body axes at these Euler angles.
[[nodiscard]] Eigen::Vector3d down_of(const Eigen::Vector3d& euler_rad);

/// A thruster at r with unit direction e advances at u_a = (v + omega x r).e; its thrust T and the reaction Q of
/// its propeller (autopilot/thrust_curve.h) act as force T e and moment r x T e + Q e about the origin.
class ThrusterForce {
 public:
  ThrusterForce(const config::LayoutThruster& thruster, double density_kg_m3)
      : thruster_(thruster), density_kg_m3_(density_kg_m3),
        of_thrust_(force_at(vector_of(thruster.place_m), vector_of(thruster.direction).normalized())) {
    of_torque_ << Eigen::Vector3d::Zero(), of_thrust_.head<3>();
  }

  /// `position`: the command after lag and dead band, in the command's unit; `factor`: of the thrust, not the
  /// reaction.
  void add(const Vector6& velocity, double position, double factor, Vector6& force) const {
    const autopilot::Thrust thrust =
        autopilot::thrust_at(thruster_, density_kg_m3_, position, of_thrust_.dot(velocity));
    force += factor * thrust.force_N * of_thrust_;
    force += thrust.torque_Nm * of_torque_;  // whole: what reads a vector behind its half waits for that
  }

 private:
  config::LayoutThruster thruster_;
  double density_kg_m3_;
  Vector6 of_thrust_;  ///< force about the origin of a unit thrust; the speed of the place along e is its product
                       ///< with the velocity
  Vector6 of_torque_;  ///< of a unit torque
};

/// A fin or wing at r with unit normal n and unit chord c meets V = v + omega x r:
///   alpha = delta - atan2(V.n, max(|V.c|, 0.001 m/s)), held within +-stall;
///   p = 1/2 rho A ((V.c)^2 + (V.n)^2);   force p a alpha n - p (CDi alpha^2 + CD0 sign(V.c)) c at r.
class SurfaceForce {
 public:
  SurfaceForce(const config::LayoutSurface& surface, double density_kg_m3)
      : pressure_kg_m_(0.5 * density_kg_m3 * surface.area_m2), slope_(surface.lift_slope_per_rad),
        induced_(surface.induced_drag), drag_(surface.drag), stall_rad_(surface.stall_rad),
        of_normal_(force_at(vector_of(surface.place_m), vector_of(surface.normal).normalized())),
        of_chord_(force_at(vector_of(surface.place_m), vector_of(surface.chord).normalized())) {}

  void add(const Vector6& velocity, double angle_rad, Vector6& force) const {
    constexpr double kLeast_m_s = 0.001;
    const double along = of_chord_.dot(velocity);
    const double across = of_normal_.dot(velocity);
    const double inflow_rad = std::atan(across / std::max(std::abs(along), kLeast_m_s));
    const double alpha = std::clamp(angle_rad - inflow_rad, -stall_rad_, stall_rad_);
    const double pressure_N = pressure_kg_m_ * (along * along + across * across);
    force += pressure_N * slope_ * alpha * of_normal_;
    force -= pressure_N * (induced_ * alpha * alpha + std::copysign(drag_, along)) * of_chord_;
  }

 private:
  double pressure_kg_m_;  ///< 1/2 rho A
  double slope_, induced_, drag_, stall_rad_;
  Vector6 of_normal_, of_chord_;  ///< force about the origin of a unit force along each
};

/// Cross-flow drag by strips (Fossen 2011, chapter 6). A strip at x is dx long, w wide and h high.
/// It meets the water with (vl, wl) = (v + x r, w - x q). Its forces are
///   dY = -1/2 rho Cd h sqrt(vl^2 + wl^2) vl dx,   dZ = -1/2 rho Cd w sqrt(vl^2 + wl^2) wl dx,
/// and it adds to the moments
///   N += x dY, M -= x dZ.
class CrossFlowStrips {
 public:
  CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3);

  /// Adds the forces about the origin at this body velocity.
  void add(const Vector6& velocity, Vector6& force) const;

 private:
  /// The processor takes strips two at a time; the last block is filled up with strips without width.
  static constexpr Eigen::Index kBlock = 4;
  using Strips = Eigen::Array<double, kBlock, 1>;
  struct Block {
    Strips x_m = Strips::Zero(), sway_kg_m = Strips::Zero(), heave_kg_m = Strips::Zero();
  };
  std::vector<Block> blocks_;
};

/// Forces of a lifting body about the origin, body axes (Graver 2005, Underwater Gliders: Dynamics, Control and
/// Design, chapter 3). With V the speed, alpha = atan2(w, u), beta = asin(v/V), both held within the stall angle
/// in the coefficients:
///   L = (l0 + l1 alpha) V^2, D = (d0 + d1 alpha^2) V^2, S = -s beta V^2;
///   K = k beta V^2, M = (m0 + m1 alpha) V^2, N = n beta V^2.
/// Drag acts against the velocity, lift across it in the plane of u and w (up in level motion ahead), S along y.
[[nodiscard]] Vector6 flow_axes_force(const config::LayoutFlowAxes& flow, const Vector6& velocity);

/// Forces of the water on the hull without its control surfaces, about the origin, SI, body axes (Fossen 2011,
/// chapter 6), the sum of
/// - linear damping -D nu and quadratic damping -D |nu| nu, element by element;
/// - lift -|u| D nu: what grows with the speed ahead, as Z_uw u w and M_uq u q of a slender hull;
/// - axial drag X = -1/2 rho Cd A |u| u;
/// - body lift Y = -1/2 rho A a |u| v, Z the same with w, acting at x: N += x Y, M -= x Z;
/// - cross-flow drag of the strips;
/// - lift and drag in axes of the flow;
/// times a factor in each degree of freedom.
class HullDamping {
 public:
  explicit HullDamping(const config::Layout& layout);

  [[nodiscard]] Vector6 operator()(const Vector6& velocity) const;

 private:
  Vector6 linear_diagonal_, quadratic_diagonal_;
  /// Beside the diagonals; nullopt where all is zero: most layouts have one of three.
  std::optional<Matrix6> linear_, quadratic_, lift_;
  double axial_kg_m_, body_lift_kg_m_, body_lift_at_m_;
  CrossFlowStrips strips_;
  std::optional<config::LayoutFlowAxes> flow_axes_;
  std::optional<Vector6> factors_;
};

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
