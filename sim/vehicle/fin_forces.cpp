// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/fin_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::sim {

FinForces::FinForces(const config::FinSettings& fins, const config::WaterSettings& water)
    : settings_(fins), pressure_kg_m_(0.5 * water.density_kg_m3 * fins.area_m2) {
  constexpr double kSide = std::numbers::sqrt3 / 2;
  constexpr std::array<std::array<double, 2>, 3> kRadial{{{0, -1}, {kSide, 0.5}, {-kSide, 0.5}}};  // in y and z
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [y, z] = kRadial[i];
    Fin& fin = fins_[i];
    const Eigen::Vector3d at_m(fins.station_m, fins.radius_m * y, fins.radius_m * z);
    const Eigen::Vector3d normal(0, -z, y);
    fin.of_normal = force_at(at_m, normal);
    fin.of_axis = force_at(at_m, Eigen::Vector3d::UnitX());
  }
}

Vector6 FinForces::operator()(const Vector6& velocity, const Eigen::Vector3d& angles_rad) const {
  constexpr double kLeastFlow_m_s = 0.001;
  Vector6 force = Vector6::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Fin& fin = fins_[i];
    // The velocity of a point along n is what a force along n at that point takes power from.
    const double along = fin.of_axis.dot(velocity);
    const double across = fin.of_normal.dot(velocity);
    const double inflow_rad = std::atan(across / std::max(std::abs(along), kLeastFlow_m_s));
    const double alpha = std::clamp(angles_rad[static_cast<Eigen::Index>(i)] - inflow_rad, -settings_.stall_rad,
                                    settings_.stall_rad);
    const double pressure_N = pressure_kg_m_ * (along * along + across * across);
    force += pressure_N * settings_.lift_slope_per_rad * alpha * fin.of_normal;
    force -= pressure_N * settings_.induced_drag * alpha * alpha * fin.of_axis;
  }
  return force;
}

}  // namespace navcal::sim
