// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/surface_force.h"

#include <algorithm>
#include <cmath>

#include "sim/layout/vector_of.h"

namespace navcal::sim {

SurfaceForce::SurfaceForce(const config::LayoutSurface& surface, double density_kg_m3)
    : pressure_kg_m_(0.5 * density_kg_m3 * surface.area_m2), slope_(surface.lift_slope_per_rad),
      induced_(surface.induced_drag), drag_(surface.drag), stall_rad_(surface.stall_rad),
      of_normal_(force_at(vector_of(surface.place_m), vector_of(surface.normal).normalized())),
      of_chord_(force_at(vector_of(surface.place_m), vector_of(surface.chord).normalized())) {}

void SurfaceForce::add(const Vector6& velocity, double angle_rad, Vector6& force) const {
  constexpr double kLeast_m_s = 0.001;
  const double along = of_chord_.dot(velocity);
  const double across = of_normal_.dot(velocity);
  const double inflow_rad = std::atan(across / std::max(std::abs(along), kLeast_m_s));
  const double alpha = std::clamp(angle_rad - inflow_rad, -stall_rad_, stall_rad_);
  const double pressure_N = pressure_kg_m_ * (along * along + across * across);
  force += pressure_N * slope_ * alpha * of_normal_;
  force -= pressure_N * (induced_ * alpha * alpha + std::copysign(drag_, along)) * of_chord_;
}

}  // namespace navcal::sim
