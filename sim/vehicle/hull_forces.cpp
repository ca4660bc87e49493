#include "sim/vehicle/hull_forces.h"

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
  const double dx_m = hull.length_m / (kStrips + 1);
  for (std::size_t i = 0; i < kStrips; ++i) {
    const double x_m = static_cast<double>(i + 1) * dx_m - half_m;
    const double width_m = hull.diameter_m * std::sqrt(1 - std::pow(x_m / half_m, 8));
    strips_[i] = {x_m, 0.5 * water.density_kg_m3 * hull.cross_flow_drag * width_m * dx_m};
  }
}

Vector6 HullForces::operator()(const Vector6& velocity) const {
  const double u = velocity[0], v = velocity[1], w = velocity[2], q = velocity[4], r = velocity[5];
  double Y = -lift_kg_m_ * std::abs(u) * v;
  double Z = -lift_kg_m_ * std::abs(u) * w;
  double M = -lift_at_m_ * Z;
  double N = lift_at_m_ * Y;
  for (const Strip& strip : strips_) {
    const double vl = v + strip.x_m * r;
    const double wl = w - strip.x_m * q;
    const double drag = -strip.drag_kg_m * std::sqrt(vl * vl + wl * wl);
    Y += drag * vl;
    Z += drag * wl;
    N += strip.x_m * drag * vl;
    M -= strip.x_m * drag * wl;
  }
  Vector6 force;
  force << -axial_kg_m_ * std::abs(u) * u, Y, Z, 0, M, N;
  return force;
}

}  // namespace navcal::sim
