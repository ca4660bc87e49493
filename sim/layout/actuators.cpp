// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/actuators.h"

#include <cmath>

#include "autopilot/thrust_curve.h"

namespace navcal::sim {
namespace {

double with_lag(double position, double target, double lag_s, double step_s) {
  return position + (1 - std::exp(-step_s / lag_s)) * (target - position);
}

double at_rate(double position, double command, double low, double high, double step) {
  return position + std::clamp(std::clamp(command, low, high) - position, -step, step);
}

ActuatorNumbers means(const ActuatorNumbers& a, const ActuatorNumbers& b) {
  ActuatorNumbers mean = a;
  for (std::size_t i = 0; i < a.size(); ++i) mean[i] = (a[i] + b[i]) / 2;
  return mean;
}

}  // namespace

ActuatorValues ActuatorValues::neutral(const config::Layout& layout) {
  ActuatorValues values;
  for (const auto& thruster : layout.thrusters)
    values.thrusters.push_back(std::clamp(thruster.neutral(), thruster.low, thruster.high));
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) values.surfaces_rad.push_back(0);
  for (const auto& ballast : layout.ballasts)
    values.ballasts_N.push_back(std::clamp(0.0, ballast.low_N, ballast.high_N));
  for (const auto& mass : layout.moving_masses)
    values.masses_m.push_back(std::clamp(0.0, mass.low_m, mass.high_m));
  return values;
}

ActuatorValues follow(const config::Layout& layout, const ActuatorValues& positions,
                      const ActuatorValues& commands, double step_s) {
  ActuatorValues next = positions;
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const config::LayoutThruster& thruster = layout.thrusters[i];
    const double target =
        autopilot::effective_command(thruster, thruster.heard.of(commands.thrusters[i], thruster.neutral()));
    next.thrusters[i] = with_lag(positions.thrusters[i], target, thruster.lag_s, step_s);
  }
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) {
    const config::LayoutSurface& surface = layout.surfaces[i];
    const double heard = surface.heard.of(commands.surfaces_rad[i], 0);
    const double target = std::abs(heard) < surface.dead_band_rad ? 0 : heard;
    const double moved = with_lag(positions.surfaces_rad[i], target, surface.lag_s, step_s);
    next.surfaces_rad[i] = std::clamp(moved, -surface.limit_rad, surface.limit_rad);
  }
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
    const config::LayoutBallast& ballast = layout.ballasts[i];
    next.ballasts_N[i] = at_rate(positions.ballasts_N[i], ballast.heard.of(commands.ballasts_N[i], 0),
                                 ballast.low_N, ballast.high_N, ballast.rate_N_s * step_s);
  }
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i) {
    const config::LayoutMovingMass& mass = layout.moving_masses[i];
    next.masses_m[i] = at_rate(positions.masses_m[i], mass.heard.of(commands.masses_m[i], 0), mass.low_m,
                               mass.high_m, mass.rate_m_s * step_s);
  }
  return next;
}

ActuatorValues mean_of(const ActuatorValues& a, const ActuatorValues& b) {
  return {means(a.thrusters, b.thrusters), means(a.surfaces_rad, b.surfaces_rad),
          means(a.ballasts_N, b.ballasts_N), means(a.masses_m, b.masses_m)};
}

}  // namespace navcal::sim
