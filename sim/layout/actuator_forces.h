// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "autopilot/thrust_curve.h"
#include "config/layout.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {

/// A thruster at r with unit direction e advances at u_a = (v + omega x r).e; its thrust T and the reaction Q of
/// its propeller (autopilot/thrust_curve.h) act as force T e and moment r x T e + Q e about the origin.
class ThrusterForce {
 public:
  ThrusterForce(const config::LayoutThruster& thruster, double density_kg_m3)
      : thruster_(thruster), density_kg_m3_(density_kg_m3),
        of_thrust_(force_at(vector_of(thruster.place_m), vector_of(thruster.direction).normalized())) {}

  /// `position`: the command after lag and dead band, in the command's unit; `factor`: of the thrust, not the
  /// reaction.
  void add(const Vector6& velocity, double position, double factor, Vector6& force) const {
    const autopilot::Thrust thrust =
        autopilot::thrust_at(thruster_, density_kg_m3_, position, of_thrust_.dot(velocity));
    force += factor * thrust.force_N * of_thrust_;
    force.tail<3>() += thrust.torque_Nm * of_thrust_.head<3>();
  }

 private:
  config::LayoutThruster thruster_;
  double density_kg_m3_;
  Vector6 of_thrust_;  ///< force about the origin of a unit thrust; the speed of the place along e is its product
                       ///< with the velocity
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

}  // namespace navcal::sim
