// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/ordered_helm.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {

void OrderedHelm::order(double time_s, const Eigen::Vector3d& fins_rad, double shaft_rps) {
  const double limit_rps = vehicle_.autopilot.shaft_limit_rps;
  waiting_.push_back({time_s, fins_rad, std::clamp(shaft_rps, -limit_rps, limit_rps)});
}

Body OrderedHelm::start() const {
  Body body;
  body.position_m.z() = kSurface_m;
  return body;
}

Actuators OrderedHelm::next(double time_s, double step_s, const Body& /*body*/) {
  actuators_.fins_ordered_rad.reset();
  for (; !waiting_.empty() && waiting_.front().time_s <= time_s + step_s / 2; waiting_.pop_front()) {
    fins_ordered_rad_ = waiting_.front().fins_rad;
    actuators_.fins_ordered_rad = fins_ordered_rad_;
    actuators_.shaft_commanded_rps = waiting_.front().shaft_rps;
  }
  const double fin_limit = vehicle_.fins.limit_rad;
  actuators_.fins_rad += (1 - std::exp(-step_s / vehicle_.fins.lag_s)) * (fins_ordered_rad_ - actuators_.fins_rad);
  actuators_.fins_rad = actuators_.fins_rad.cwiseMax(-fin_limit).cwiseMin(fin_limit);
  const double change_rps =
      (1 - std::exp(-step_s / vehicle_.propeller.lag_s)) * (actuators_.shaft_commanded_rps - actuators_.shaft_rps);
  const double greatest_rps = kGreatestAcceleration_rps_s * step_s;
  actuators_.shaft_rps += std::clamp(change_rps, -greatest_rps, greatest_rps);
  return actuators_;
}

}  // namespace navcal::sim
