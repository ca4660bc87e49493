// SPDX-License-Identifier: Apache-2.0
#include "autopilot/autopilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "autopilot/shaft_speed.h"

namespace navcal::autopilot {
namespace {

/// Gain on an error and on its integral, and a limit. The integral is for what stands against the vehicle all the
/// time: it grows only where the error alone asks for a small part of the limit, so that long changes leave
/// nothing in it.
double limited(double by_error, double per_integral, double limit, double error, double period_s,
               double& integral) {
  constexpr double kSmallPart = 0.25;
  if (std::abs(by_error) < kSmallPart * limit) integral += error * period_s;
  return std::clamp(by_error + per_integral * integral, -limit, limit);
}

}  // namespace

Eigen::Vector3d mixed_fins(double rudder_rad, double elevator_rad) {
  constexpr double kSide = std::numbers::sqrt3 / 2;
  return {-rudder_rad, rudder_rad / 2 + kSide * elevator_rad, rudder_rad / 2 - kSide * elevator_rad};
}

Autopilot::Autopilot(const config::VehicleSettings& settings)
    : settings_(settings.autopilot), propeller_(settings.propeller), fin_limit_rad_(settings.fins.limit_rad),
      density_kg_m3_(settings.water.density_kg_m3), drag_kg_m_(axial_drag_kg_m(settings)) {}

Orders Autopilot::orders(const Demand& demand, const VehicleState& state, double period_s) {
  Orders orders;
  orders.rudder_rad = demand.rudder_rad ? *demand.rudder_rad : rudder(demand, state);
  orders.elevator_rad = demand.elevator_rad ? *demand.elevator_rad : elevator(demand, state, period_s);
  orders.fins_rad = mixed_fins(orders.rudder_rad, orders.elevator_rad);
  for (std::size_t i = 0; i < 3; ++i) {
    double& fin = orders.fins_rad[static_cast<Eigen::Index>(i)];
    fin = std::clamp(demand.fins_rad[i].value_or(fin), -fin_limit_rad_, fin_limit_rad_);
  }
  orders.shaft_rps = std::clamp(shaft(demand, state, period_s), 0.0, settings_.shaft_limit_rps);
  return orders;
}

double Autopilot::rudder(const Demand& demand, const VehicleState& state) const {
  const double turn =
      (std::sin(state.euler_rad[0]) * state.rate_rad_s[1] + std::cos(state.euler_rad[0]) * state.rate_rad_s[2]) /
      std::cos(state.euler_rad[1]);
  const double wanted = settings_.rudder_per_heading * (demand.heading_rad - state.euler_rad[2]) +
                        settings_.rudder_per_turn_s * (demand.turn_rad_s - turn);
  return std::clamp(wanted, -settings_.rudder_limit_rad, settings_.rudder_limit_rad);
}

double Autopilot::elevator(const Demand& demand, const VehicleState& state, double period_s) {
  const double too_deep_m = state.depth_m - demand.depth_m;
  const double pitch =
      limited(settings_.pitch_per_depth_rad_m * too_deep_m, settings_.pitch_per_depth_integral_rad_m_s,
              settings_.pitch_limit_rad, too_deep_m, period_s, depth_integral_m_s_);
  const double error = pitch - state.euler_rad[1];
  return limited(settings_.elevator_per_pitch * error - settings_.elevator_per_turn_s * state.rate_rad_s[1],
                 settings_.elevator_per_pitch_integral_per_s, settings_.elevator_limit_rad, error, period_s,
                 pitch_integral_rad_s_);
}

double Autopilot::shaft(const Demand& demand, const VehicleState& state, double period_s) {
  if (!demand.speed_m_s) return demand.shaft_rps;
  const double error = *demand.speed_m_s - state.surge_m_s;
  const double usual = shaft_for(propeller_, density_kg_m3_, *demand.speed_m_s, drag_kg_m_);
  return usual + limited(settings_.shaft_per_speed_per_m * error, settings_.shaft_per_way_per_m_s,
                         settings_.shaft_limit_rps, error, period_s, speed_integral_m_);
}

}  // namespace navcal::autopilot
