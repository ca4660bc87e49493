// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/layout_mission_helm.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/layout/control/mission_needs.h"
#include "sim/layout/pulses.h"

namespace navcal::sim {

LayoutMissionHelm::LayoutMissionHelm(const config::Layout& layout, config::Mission mission)
    : vehicle_(layout), allocator_(layout), steps_(std::move(mission)),
      plan_(plan_control(vehicle_, allocator_, steps_.mission())), autopilot_(vehicle_, allocator_, plan_),
      pulses_us_(pulses_of(layout, ActuatorValues::neutral(layout))) {}

const std::vector<double>& LayoutMissionHelm::next(double /*time_s*/, double step_s, const Body& body) {
  steps_.add_way(body.velocity.head<3>().norm() * step_s);
  // Half a step: the sum of steps is no round number.
  if (until_orders_s_ < 0.5 * step_s) {
    expect_progress();
    const autopilot::Demand& demand = steps_.next(vehicle_state(body), kPeriod_s, autopilot_.last());
    pulses_us_ = pulses_of(vehicle_.layout(), autopilot_.commands(demand, body, kPeriod_s));
    until_orders_s_ += kPeriod_s;
  }
  until_orders_s_ -= step_s;
  return pulses_us_;
}

std::string LayoutMissionHelm::remark() const {
  const config::Mission& mission = steps_.mission();
  double fastest_m_s = speed_of_shaft(mission.start.shaft_rps);
  for (const config::MissionStep& step : mission.steps) {
    fastest_m_s = std::max(fastest_m_s, step.speed_m_s.value_or(0));
    fastest_m_s = std::max(fastest_m_s, speed_of_shaft(step.shaft_rps.value_or(0)));
  }
  if (!plan_.commanded[0] || fastest_m_s <= plan_.greatest_m_s) return {};
  return fmt::format(
      "{}: speeds are held at {:.2f} m/s, the most that the autopilot trusts this layout with; the mission "
      "asks for up to {:.2f} m/s",
      vehicle_.layout().name, plan_.greatest_m_s, fastest_m_s);
}

void LayoutMissionHelm::expect_progress() const {
  constexpr double kLongest_s = 600, kLeast_m_s = 0.005;
  const std::size_t step = steps_.step();
  if (steps_.finished() || step >= steps_.mission().steps.size() || steps_.since_s() < kLongest_s) return;
  const auto& metres = steps_.mission().steps[step].metres;
  if (!metres || steps_.way_m() > kLeast_m_s * steps_.since_s()) return;
  throw UnfitLayout(fmt::format("{}: {} of the mission does not end: {:.2f} of {:g} m in {:.0f} s",
                                vehicle_.layout().name, step_words(steps_.mission(), step), steps_.way_m(),
                                *metres, steps_.since_s()));
}

}  // namespace navcal::sim
