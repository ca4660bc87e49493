// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/pulses.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {
namespace {

constexpr double kNeutral_us = 1500;
constexpr double kSpan_us = 400;

double pulse_of(const PulseRange& range, double command) {
  const double within = std::clamp(command, range.low, range.high);
  if (range.is_pulse) return std::round(within);
  const double span = within > range.neutral ? range.high - range.neutral : range.neutral - range.low;
  return std::round(kNeutral_us + (span > 0 ? kSpan_us * (within - range.neutral) / span : 0));
}

/// Calls on(range, value) for every actuator, in the order of the pulses.
template <class Values, class On>
void each_command(const config::Layout& layout, Values& values, On on) {
  const std::vector<PulseRange> ranges = pulse_ranges(layout);
  auto range = ranges.begin();
  for (auto* numbers : {&values.thrusters, &values.surfaces_rad, &values.ballasts_N, &values.masses_m}) {
    for (auto& value : *numbers) on(*range++, value);
  }
}

}  // namespace

double PulseRange::command(double pulse_us) const {
  if (is_pulse) return pulse_us;
  const double part = (pulse_us - kNeutral_us) / kSpan_us;
  return neutral + part * (part > 0 ? high - neutral : neutral - low);
}

std::vector<PulseRange> pulse_ranges(const config::Layout& layout) {
  std::vector<PulseRange> ranges;
  const auto add = [&](double low, double neutral, double high, bool is_pulse = false) {
    ranges.push_back({low, std::clamp(neutral, low, high), high, is_pulse});
  };
  for (const config::LayoutThruster& one : layout.thrusters)
    add(one.low, one.neutral(), one.high, one.unit == config::CommandUnit::microseconds);
  for (const config::LayoutSurface& one : layout.surfaces) add(-one.limit_rad, 0, one.limit_rad);
  for (const config::LayoutBallast& one : layout.ballasts) add(one.low_N, 0, one.high_N);
  for (const config::LayoutMovingMass& one : layout.moving_masses) add(one.low_m, 0, one.high_m);
  return ranges;
}

std::vector<double> pulses_of(const config::Layout& layout, const ActuatorValues& commands) {
  std::vector<double> pulses;
  each_command(layout, commands, [&](const PulseRange& range, const double& command) {
    pulses.push_back(pulse_of(range, command));
  });
  return pulses;
}

ActuatorValues commands_of(const config::Layout& layout, const std::vector<double>& pulses_us) {
  ActuatorValues commands = ActuatorValues::neutral(layout);
  auto pulse_us = pulses_us.begin();
  each_command(layout, commands, [&](const PulseRange& range, double& command) {
    if (pulse_us != pulses_us.end()) command = std::clamp(range.command(*pulse_us++), range.low, range.high);
  });
  return commands;
}

std::size_t outputs_of(const config::Layout& layout) {
  return layout.thrusters.size() + layout.surfaces.size() + layout.ballasts.size() + layout.moving_masses.size();
}

}  // namespace navcal::sim
