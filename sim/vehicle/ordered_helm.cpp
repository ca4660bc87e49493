// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/ordered_helm.h"

#include <algorithm>

#include "sim/layout/layout_of.h"
#include "sim/layout/pulses.h"

namespace navcal::sim {

OrderedHelm::OrderedHelm(const config::VehicleSettings& vehicle)
    : layout_(layout_of(vehicle)), is_card_(true), numbers_(4) {
  layout_.thrusters[0].low = -layout_.thrusters[0].high;
}

OrderedHelm::OrderedHelm(const config::Layout& layout)
    : layout_(layout), is_card_(false), numbers_(pulses_of(layout, ActuatorValues::neutral(layout))) {}

Body OrderedHelm::start() const {
  Body body;
  body.position_m.z() = kSurface_m;
  return body;
}

void OrderedHelm::next(double time_s, double step_s, const Body& /*body*/, Actuators& actuators) {
  for (; !waiting_.empty() && waiting_.front().time_s <= time_s + step_s / 2; waiting_.pop_front()) {
    const auto& wanted = waiting_.front().numbers;
    for (std::size_t i = 0; i < std::min(numbers_.size(), wanted.size()); ++i)
      numbers_[i] = wanted[i].value_or(numbers_[i]);
    actuators.is_new_order = true;
  }
  if (!is_card_) {
    actuators.pulses_us = numbers_;
    return;
  }
  const config::LayoutThruster& propeller = layout_.thrusters[0];
  actuators.commands = {
      {std::clamp(numbers_[0], propeller.low, propeller.high)}, {numbers_[1], numbers_[2], numbers_[3]}, {}, {}};
  const double before_rpm = actuators.positions.thrusters[0];
  actuators.positions = follow(layout_, actuators.positions, actuators.commands, step_s);
  double& rpm = actuators.positions.thrusters[0];
  const double most_rpm = 60 * kGreatestAcceleration_rps_s * step_s;
  rpm = std::clamp(rpm, before_rpm - most_rpm, before_rpm + most_rpm);
}

}  // namespace navcal::sim
