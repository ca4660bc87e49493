// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/pulses.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {
namespace {

constexpr double kNeutral_us = 1500;
constexpr double kSpan_us = 400;

/// Command of one actuator: its limits, and where it is neutral.
struct CommandRange {
  double low, neutral, high;
  bool is_pulse;
};

/// Calls on(range, value) for every actuator, in the order of the pulses.
template <class Values, class On>
void each_command(const config::Layout& layout, Values& values, On on) {
  const auto about = [](double low, double high) {
    return CommandRange{low, std::clamp(0.0, low, high), high, false};
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const config::LayoutThruster& thruster = layout.thrusters[i];
    const double neutral = std::clamp(thruster.neutral(), thruster.low, thruster.high);
    on(CommandRange{thruster.low, neutral, thruster.high, thruster.unit == config::CommandUnit::microseconds},
       values.thrusters[i]);
  }
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i)
    on(about(-layout.surfaces[i].limit_rad, layout.surfaces[i].limit_rad), values.surfaces_rad[i]);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i)
    on(about(layout.ballasts[i].low_N, layout.ballasts[i].high_N), values.ballasts_N[i]);
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i)
    on(about(layout.moving_masses[i].low_m, layout.moving_masses[i].high_m), values.masses_m[i]);
}

double pulse_of(const CommandRange& range, double command) {
  const double within = std::clamp(command, range.low, range.high);
  if (range.is_pulse) return std::round(within);
  const double span = within > range.neutral ? range.high - range.neutral : range.neutral - range.low;
  return std::round(kNeutral_us + (span > 0 ? kSpan_us * (within - range.neutral) / span : 0));
}

double command_of(const CommandRange& range, double pulse_us) {
  if (range.is_pulse) return std::clamp(pulse_us, range.low, range.high);
  const double part = std::clamp((pulse_us - kNeutral_us) / kSpan_us, -1.0, 1.0);
  return range.neutral + part * (part > 0 ? range.high - range.neutral : range.neutral - range.low);
}

}  // namespace

std::vector<double> pulses_of(const config::Layout& layout, const ActuatorValues& commands) {
  std::vector<double> pulses;
  each_command(layout, commands, [&](const CommandRange& range, const double& command) {
    pulses.push_back(pulse_of(range, command));
  });
  return pulses;
}

ActuatorValues commands_of(const config::Layout& layout, const std::vector<double>& pulses_us) {
  ActuatorValues commands = ActuatorValues::neutral(layout);
  std::size_t next = 0;
  each_command(layout, commands, [&](const CommandRange& range, double& command) {
    if (next < pulses_us.size()) command = command_of(range, pulses_us[next]);
    ++next;
  });
  return commands;
}

std::size_t outputs_of(const config::Layout& layout) {
  return layout.thrusters.size() + layout.surfaces.size() + layout.ballasts.size() + layout.moving_masses.size();
}

}  // namespace navcal::sim
