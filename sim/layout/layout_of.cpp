// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/layout_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/gravity.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim {
namespace {

config::LayoutBody body_of(const config::HullSettings& hull) {
  const double m = hull.mass_kg, b = hull.diameter_m / 2;
  const double roll = hull.roll_inertia_factor * m * b * b;
  const double pitch = hull.pitch_inertia_factor * m * (hull.length_m * hull.length_m / 12 + b * b / 4);
  config::LayoutBody body;
  body.mass_kg = m;
  body.gravity_centre_m = {0, 0, hull.gravity_below_m};
  body.inertia_kg_m2 = {roll, pitch, pitch, 0, 0, 0};
  body.buoyancy_N = m * base::kGravity_m_s2;
  body.size_m = {hull.length_m, hull.diameter_m, hull.diameter_m};
  return body;
}

config::LayoutMatrix added_mass_of(const config::HullSettings& hull, const config::LayoutBody& body) {
  const LambFactors lamb = lamb_factors(hull.length_m, hull.diameter_m);
  config::LayoutMatrix matrix{};
  matrix[0] = lamb.axial * hull.mass_kg;
  matrix[7] = matrix[14] = lamb.transverse * hull.mass_kg;
  matrix[21] = hull.roll_added_factor * body.inertia_kg_m2[0];
  matrix[28] = matrix[35] = lamb.rotational * body.inertia_kg_m2[1];
  return matrix;
}

config::LayoutMatrix linear_damping_of(const config::VehicleSettings& vehicle, const Matrix6& mass) {
  const double restoring_Nm = vehicle.hull.mass_kg * base::kGravity_m_s2 * vehicle.hull.gravity_below_m;
  const auto oscillation = [&](double ratio, double inertia) {
    return 2 * ratio * std::sqrt(restoring_Nm / inertia) * inertia;
  };
  config::LayoutMatrix linear{};
  linear[21] = oscillation(vehicle.damping.roll_ratio, mass(3, 3));
  linear[28] = oscillation(vehicle.damping.pitch_ratio, mass(4, 4));
  linear[35] = vehicle.damping.yaw_per_s * mass(5, 5);
  return linear;
}

/// 21 stations, evenly from stern to bow, without the first: both ends have no width.
config::LayoutStrips strips_of(const config::HullSettings& hull) {
  constexpr int kStrips = 20;
  const double half_m = hull.length_m / 2, dx_m = hull.length_m / kStrips;
  config::LayoutStrips strips;
  for (int i = 1; i <= kStrips; ++i) {
    const double x = static_cast<double>(i) * dx_m - half_m;
    strips.x_m.push_back(x);
    strips.length_m.push_back(dx_m);
    strips.width_m.push_back(hull.diameter_m * std::sqrt(std::max(0.0, 1 - std::pow(x / half_m, 8))));
  }
  strips.height_m = strips.width_m;
  return strips;
}

config::LayoutThruster propeller_of(const config::VehicleSettings& vehicle) {
  config::LayoutThruster thruster;
  thruster.name = "propeller";
  thruster.place_m = {-vehicle.hull.length_m / 2, 0, 0};
  thruster.diameter_m = vehicle.propeller.diameter_m;
  thruster.KT = {vehicle.propeller.thrust_at_rest, vehicle.propeller.thrust_slope};
  thruster.KQ = {vehicle.propeller.torque};
  thruster.torque_share = vehicle.propeller.torque_felt;
  thruster.is_left_handed = true;
  thruster.reverse_efficiency = 0;
  thruster.lag_s = vehicle.propeller.lag_s;
  thruster.high = 60 * vehicle.autopilot.shaft_limit_rps;
  return thruster;
}

std::vector<config::LayoutSurface> fins_of(const config::FinSettings& fins) {
  constexpr double kSide = std::numbers::sqrt3 / 2;
  constexpr std::array<std::array<double, 2>, 3> kRadial{{{0, -1}, {kSide, 0.5}, {-kSide, 0.5}}};  // in y and z
  std::vector<config::LayoutSurface> surfaces;
  for (const auto& [y, z] : kRadial) {
    config::LayoutSurface surface;
    surface.name = fmt::format("fin_{}", surfaces.size() + 1);
    surface.place_m = {fins.station_m, fins.radius_m * y, fins.radius_m * z};
    surface.normal = {0, -z, y};
    surface.area_m2 = fins.area_m2;
    surface.lift_slope_per_rad = fins.lift_slope_per_rad;
    surface.induced_drag = fins.induced_drag;
    surface.stall_rad = fins.stall_rad;
    surface.lag_s = fins.lag_s;
    surface.limit_rad = fins.limit_rad;
    surfaces.push_back(surface);
  }
  return surfaces;
}

}  // namespace

config::Layout layout_of(const config::VehicleSettings& vehicle) {
  const config::HullSettings& hull = vehicle.hull;
  config::Layout layout;
  layout.name = "vehicle with one propeller and three fins";
  layout.water_density_kg_m3 = vehicle.water.density_kg_m3;
  layout.body = body_of(hull);
  layout.added_mass.matrix_kg = added_mass_of(hull, layout.body);
  layout.damping.linear = linear_damping_of(vehicle, rigid_body_mass(layout, {}) + added_mass(layout));
  layout.damping.axial_coefficient = hull.axial_drag;
  layout.damping.axial_area_m2 = std::numbers::pi * hull.diameter_m * hull.diameter_m / 4;
  layout.damping.body_lift_slope_per_rad = hull.lift_slope_per_rad;
  layout.damping.body_lift_area_m2 = hull.lift_area_factor * hull.length_m * hull.diameter_m;
  layout.damping.body_lift_at_m = hull.lift_at_m;
  layout.damping.cross_flow_coefficient = hull.cross_flow_drag;
  layout.damping.strips = strips_of(hull);
  layout.thrusters = {propeller_of(vehicle)};
  layout.surfaces = fins_of(vehicle.fins);
  return layout;
}

}  // namespace navcal::sim
