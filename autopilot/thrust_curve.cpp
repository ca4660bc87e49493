// SPDX-License-Identifier: Apache-2.0
#include "autopilot/thrust_curve.h"

#include <algorithm>
#include <cmath>

namespace navcal::autopilot {
namespace {

double polynomial(const std::vector<double>& coefficients, double x) {
  double value = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * x + *c;
  return value;
}

Thrust propeller_thrust(const config::LayoutThruster& thruster, double density_kg_m3, double rpm,
                        double advance_m_s) {
  const double n = rpm / 60;
  if (n == 0 || std::isnan(n)) return {};
  const double D = thruster.diameter_m;
  const double sign = n > 0 ? 1 : -1;
  const double J = std::max(sign * advance_m_s, 0.0) / (sign * n * D);
  const double KT = std::max(polynomial(thruster.KT, J), 0.0);
  const double scale_N =
      thruster.force_scale * density_kg_m3 * n * n * D * D * D * D * (n > 0 ? 1 : -thruster.reverse_efficiency);
  return {scale_N * KT, thruster.torque_share * scale_N * D * polynomial(thruster.KQ, J)};
}

double at_rest_N(const config::LayoutThruster& thruster, double command) {
  const auto& commands = thruster.table_command;
  const auto& forces = thruster.table_force_N;
  const auto above = std::ranges::upper_bound(commands, command);
  if (above == commands.begin()) return thruster.force_scale * forces.front();
  if (above == commands.end()) return thruster.force_scale * forces.back();
  const auto i = static_cast<std::size_t>(above - commands.begin());
  const double part = (command - commands[i - 1]) / (commands[i] - commands[i - 1]);
  return thruster.force_scale * (forces[i - 1] + part * (forces[i] - forces[i - 1]));
}

Thrust table_thrust(const config::LayoutThruster& thruster, double command, double advance_m_s) {
  const double at_rest = at_rest_N(thruster, command);
  const double under_way = at_rest - thruster.advance_loss_sqrtN_s_m * std::sqrt(std::abs(at_rest)) * advance_m_s;
  const double force = at_rest > 0 ? std::max(under_way, 0.0) : std::min(under_way, 0.0);
  return {force, thruster.torque_share * thruster.torque_m * force};
}

}  // namespace

Thrust thrust_at(const config::LayoutThruster& thruster, double density_kg_m3, double position,
                 double advance_m_s) {
  Thrust thrust = thruster.diameter_m > 0 ? propeller_thrust(thruster, density_kg_m3, position, advance_m_s)
                                          : table_thrust(thruster, position, advance_m_s);
  if (!thruster.is_left_handed) thrust.torque_Nm = -thrust.torque_Nm;
  return thrust;
}

double effective_command(const config::LayoutThruster& thruster, double command) {
  const double within = std::clamp(command, thruster.low, thruster.high);
  const double neutral = std::clamp(thruster.neutral(), thruster.low, thruster.high);
  const double beyond = std::abs(within - thruster.neutral()) - thruster.dead_band, edge = thruster.dead_band_edge;
  if (beyond >= edge) return within;
  return beyond <= -edge ? neutral : neutral + (beyond + edge) / (2 * edge) * (within - neutral);
}

double command_for(const config::LayoutThruster& thruster, double density_kg_m3, double force_N,
                   double advance_m_s) {
  const auto force_at = [&](double command) {
    return thrust_at(thruster, density_kg_m3, effective_command(thruster, command), advance_m_s).force_N;
  };
  const double neutral = std::clamp(thruster.neutral(), thruster.low, thruster.high);
  const bool forwards = force_N >= force_at(neutral);
  // Between neutral and the limit on that side the force grows away from neutral.
  double near = neutral, far = forwards ? thruster.high : thruster.low;
  const auto is_enough = [&](double command) {
    return forwards ? force_at(command) >= force_N : force_at(command) <= force_N;
  };
  if (is_enough(near)) return near;
  if (!is_enough(far)) return far;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (near + far) / 2;
    (is_enough(middle) ? far : near) = middle;
  }
  // At the edge of a dead band the force jumps: the nearer side of the jump.
  return std::abs(force_at(near) - force_N) < std::abs(force_at(far) - force_N) ? near : far;
}

}  // namespace navcal::autopilot
