// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "sim/layout/assessment/parts.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::assessment {
namespace {

constexpr double kGreatest_m_s = 30;

/// Thrusters whose unit direction has a component along an axis drive it with this part of their range.
ActuatorValues driven_along(const config::Layout& layout, int axis, double part) {
  constexpr double kLeast = 0.05;
  ActuatorValues values = ActuatorValues::neutral(layout);
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const config::LayoutThruster& thruster = layout.thrusters[i];
    const double along = (part >= 0 ? 1 : -1) * vector_of(thruster.direction).normalized()[axis];
    const double limit = along > 0 ? thruster.high : thruster.low;
    if (std::abs(along) > kLeast)
      values.thrusters[i] = thruster.neutral() + std::abs(part) * (limit - thruster.neutral());
  }
  return values;
}

/// Speed along a body axis at which the force on a level vehicle vanishes.
SteadySpeed settled(std::string what, const LayoutVehicle& vehicle, int axis, const ActuatorValues& values) {
  const LayoutVehicle::Held held = vehicle.hold(values);
  const auto force_at = [&](double speed_m_s) {
    Vector6 velocity = Vector6::Zero();
    velocity[axis] = speed_m_s;
    return vehicle.force(velocity, Eigen::Vector3d::UnitZ(), held)[axis];
  };
  SteadySpeed steady{std::move(what), force_at(0), {}};
  const double sign = steady.force_N > 0 ? 1 : -1;
  double low = 0, high = 0.1;
  while (high < kGreatest_m_s && sign * force_at(sign * high) > 0) high *= 2;
  if (sign * force_at(sign * high) > 0) return steady;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (sign * force_at(sign * middle) > 0 ? low : high) = middle;
  }
  steady.speed_m_s = sign * low;
  return steady;
}

bool drives(const SteadySpeed& steady, const config::Layout& layout) {
  return std::abs(steady.force_N) > 1e-6 * layout.weight_N();
}

}  // namespace

ActuatorValues ahead_at(const config::Layout& layout, double part) { return driven_along(layout, 0, part); }

std::vector<SteadySpeed> speeds_ahead(const LayoutVehicle& vehicle) {
  std::vector<SteadySpeed> speeds;
  for (const int percent : {25, 50, 75, 100}) {
    speeds.push_back(settled(fmt::format("{} % command", percent), vehicle, 0,
                             driven_along(vehicle.layout(), 0, percent / 100.0)));
  }
  return drives(speeds.back(), vehicle.layout()) ? speeds : std::vector<SteadySpeed>{};
}

std::vector<SteadySpeed> speeds_downwards(const LayoutVehicle& vehicle) {
  const config::Layout& layout = vehicle.layout();
  const ActuatorValues neutral = ActuatorValues::neutral(layout);
  std::vector<SteadySpeed> speeds;
  const auto add = [&](std::string what, const ActuatorValues& values) {
    SteadySpeed steady = settled(std::move(what), vehicle, 2, values);
    if (drives(steady, layout)) speeds.push_back(std::move(steady));
  };
  add("all neutral", neutral);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
    for (const double added_N : {layout.ballasts[i].low_N, layout.ballasts[i].high_N}) {
      ActuatorValues values = neutral;
      values.ballasts_N[i] = added_N;
      add(fmt::format("{} at {} N", layout.ballasts[i].name, added_N), values);
    }
  }
  const ActuatorValues down = driven_along(layout, 2, 1), up = driven_along(layout, 2, -1);
  if (down.thrusters != neutral.thrusters) add("thrusters full down", down);
  if (up.thrusters != neutral.thrusters) add("thrusters full up", up);
  return speeds;
}

}  // namespace navcal::sim::assessment
