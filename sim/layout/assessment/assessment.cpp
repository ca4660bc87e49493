// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/assessment/assessment.h"

#include "sim/layout/assessment/parts.h"

namespace navcal::sim {

Assessment assess(const config::Layout& layout) {
  Assessment result;
  result.cannot_simulate = assessment::reason_not_to_simulate(layout);
  result.odd = assessment::oddities_of_file(layout);
  if (!result.cannot_simulate.empty()) return result;
  const LayoutVehicle vehicle(layout);
  result.statics = assessment::statics_of(vehicle);
  result.ahead = assessment::speeds_ahead(vehicle);
  result.downwards = assessment::speeds_downwards(vehicle);
  const double ahead_m_s = result.ahead.empty() ? 0 : result.ahead.back().speed_m_s.value_or(0);
  result.motions = assessment::motions_of(vehicle, ahead_m_s);
  const autopilot::Allocator allocator(layout);
  autopilot::Wrench velocity = autopilot::Wrench::Zero();
  result.at_rest = autopilot::controllability(allocator, velocity);
  constexpr double kSlow_m_s = 0.5;
  result.under_way_m_s = ahead_m_s > 0 ? 0.5 * ahead_m_s : kSlow_m_s;
  velocity[0] = result.under_way_m_s;
  result.under_way = autopilot::controllability(allocator, velocity);
  for (Oddity& oddity : assessment::oddities_of_motion(vehicle, result)) result.odd.push_back(std::move(oddity));
  return result;
}

}  // namespace navcal::sim
