// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/hull_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::sim {

HullForces::HullForces(const config::HullSettings& hull, const config::WaterSettings& water)
    : axial_kg_m_(0.5 * water.density_kg_m3 * hull.axial_drag * std::numbers::pi * hull.diameter_m *
                  hull.diameter_m / 4),
      lift_kg_m_(0.5 * water.density_kg_m3 * hull.lift_area_factor * hull.length_m * hull.diameter_m *
                 hull.lift_slope_per_rad),
      lift_at_m_(hull.lift_at_m) {
  const double half_m = hull.length_m / 2;
  const double dx_m = hull.length_m / kStrips;
  for (Eigen::Index i = 0; i < kStrips; ++i) {
    x_m_[i] = static_cast<double>(i + 1) * dx_m - half_m;
    const double width_m = hull.diameter_m * std::sqrt(std::max(0.0, 1 - std::pow(x_m_[i] / half_m, 8)));
    drag_kg_m_[i] = 0.5 * water.density_kg_m3 * hull.cross_flow_drag * width_m * dx_m;
  }
}

Vector6 HullForces::operator()(const Vector6& velocity) const {
  const double u = velocity[0], v = velocity[1], w = velocity[2], q = velocity[4], r = velocity[5];
  double Y = -lift_kg_m_ * std::abs(u) * v;
  double Z = -lift_kg_m_ * std::abs(u) * w;
  double M = -lift_at_m_ * Z;
  double N = lift_at_m_ * Y;
  const Strips vl = v + r * x_m_;
  const Strips wl = w - q * x_m_;
  const Strips drag = drag_kg_m_ * (vl.square() + wl.square()).sqrt();
  const Strips across = drag * vl, down = drag * wl;
  Y -= across.sum();
  Z -= down.sum();
  N -= (x_m_ * across).sum();
  M += (x_m_ * down).sum();
  Vector6 force;
  force << -axial_kg_m_ * std::abs(u) * u, Y, Z, 0, M, N;
  return force;
}

}  // namespace navcal::sim
