// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "config/layout.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {

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
