// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/mission_helm.h"

#include <cmath>
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
    : vehicle_(vehicle), orders_(vehicle, std::move(mission)), actuators_(actuators_at_start()) {}

Actuators MissionHelm::actuators_at_start() const {
  const double shaft_rps = orders_.mission().start.shaft_rps;
  return {Eigen::Vector3d::Zero(), shaft_rps, shaft_rps};
}

Actuators MissionHelm::next(double /*time_s*/, double step_s, const Body& body) {
  orders_.add_way(body.velocity.head<3>().norm() * step_s);
  actuators_.fins_ordered_rad.reset();
  // Half a step: the sum of steps is no round number.
  if (until_orders_s_ < 0.5 * step_s) {
    const autopilot::Orders before = orders_.last();
    const autopilot::Orders& now = orders_.next(vehicle_state(body), vehicle_.autopilot.period_s);
    if (now.fins_rad != before.fins_rad || now.shaft_rps != before.shaft_rps) {
      actuators_.fins_ordered_rad = now.fins_rad;
    }
    until_orders_s_ += vehicle_.autopilot.period_s;
  }
  until_orders_s_ -= step_s;
  const autopilot::Orders& orders = orders_.last();
  const double limit = vehicle_.fins.limit_rad;
  const double fin_part = 1 - std::exp(-step_s / vehicle_.fins.lag_s);
  actuators_.fins_rad += fin_part * (orders.fins_rad - actuators_.fins_rad);
  actuators_.fins_rad = actuators_.fins_rad.cwiseMax(-limit).cwiseMin(limit);
  actuators_.shaft_rps +=
      (1 - std::exp(-step_s / vehicle_.propeller.lag_s)) * (orders.shaft_rps - actuators_.shaft_rps);
  actuators_.shaft_commanded_rps = orders.shaft_rps;
  return actuators_;
}

}  // namespace navcal::sim
