// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/mission_helm.h"

#include <utility>

namespace navcal::sim {

Body body_at(const config::MissionStart& start) {
  Body body;
  body.position_m.z() = start.depth_m;
  body.euler_rad.z() = start.heading_rad;
  body.velocity[0] = start.speed_m_s;
  return body;
}

autopilot::VehicleState vehicle_state(const Body& body) {
  return {body.position_m.z(), body.euler_rad, body.velocity.tail<3>(), body.velocity[0]};
}

MissionHelm::MissionHelm(const config::VehicleSettings& vehicle, config::Mission mission)
    : period_s_(vehicle.autopilot.period_s), orders_(vehicle, std::move(mission)) {}

void MissionHelm::next(double /*time_s*/, double step_s, const Body& body, Actuators& actuators) {
  orders_.add_way(body.velocity.head<3>().norm() * step_s);
  // Half a step: the sum of steps is no round number.
  if (until_orders_s_ < 0.5 * step_s) {
    const autopilot::Orders before = orders_.last();
    const autopilot::Orders& now = orders_.next(vehicle_state(body), period_s_);
    actuators.is_new_order = now.fins_rad != before.fins_rad || now.shaft_rps != before.shaft_rps;
    actuators.commands = Controls{now.fins_rad, now.shaft_rps}.values();
    until_orders_s_ += period_s_;
  }
  until_orders_s_ -= step_s;
}

}  // namespace navcal::sim
