// SPDX-License-Identifier: Apache-2.0
#include "identify/data/actuator_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.h"
#include "base/enum_name.h"
#include "gap/actuators/actuator_track.h"

namespace navcal::identify {
namespace {

/// Half width of the end of a dead band, as part of half the command's range. Where a dead band ends is not known
/// better, and a command that crosses a sharp end makes a jump, which has no slope.
constexpr double kSoftEdge = 0.02;

/// The value that holds at a time; `at` is where the search of the time before ended.
double held_at(const Signal& signal, double time_s, std::size_t& at) {
  while (at + 1 < signal.times_s.size() && signal.times_s[at + 1] <= time_s) ++at;
  return signal.values[at];
}

double linear_at(const Signal& signal, double time_s, std::size_t& at) {
  const double held = held_at(signal, time_s, at);
  if (at + 1 >= signal.times_s.size() || time_s <= signal.times_s[at]) return held;
  const double part = (time_s - signal.times_s[at]) / (signal.times_s[at + 1] - signal.times_s[at]);
  return held + part * (signal.values[at + 1] - held);
}

struct Limits {
  double low, high;
  std::string unit;
  double per_unit = 1;
};

void add_oddities(const std::string& actuator, const std::string& channel, const Signal& signal,
                  const Limits& limits, double duration_s, std::vector<std::string>& out) {
  constexpr double kOften = 0.2, kLongGap_s = 1, kPart = 1e-3;
  const double margin = kPart * (limits.high - limits.low);
  std::size_t at_limit = 0;
  double longest_s = 0, least = signal.values.front(), greatest = least;
  for (std::size_t i = 0; i < signal.values.size(); ++i) {
    const double value = signal.values[i];
    least = std::min(least, value);
    greatest = std::max(greatest, value);
    if (value <= limits.low + margin || value >= limits.high - margin) ++at_limit;
    if (i > 0) longest_s = std::max(longest_s, signal.times_s[i] - signal.times_s[i - 1]);
  }
  if (least < limits.low - margin || greatest > limits.high + margin)
    out.push_back(
        fmt::format("{}: commands of {} reach from {:.4g} to {:.4g} {}, beyond the limits {:.4g} to {:.4g}",
                    actuator, channel, least / limits.per_unit, greatest / limits.per_unit, limits.unit,
                    limits.low / limits.per_unit, limits.high / limits.per_unit));
  const double share = static_cast<double>(at_limit) / static_cast<double>(signal.values.size());
  if (share > kOften && limits.low < limits.high)
    out.push_back(
        fmt::format("{}: saturated: {} stands at a limit {:.0f} % of the time", actuator, channel, 100 * share));
  const double late_s = signal.times_s.front(), early_s = duration_s - signal.times_s.back();
  if (std::max({longest_s, late_s, early_s}) > kLongGap_s && greatest > least)
    out.push_back(fmt::format("{}: {} is not recorded for up to {:.1f} s; its last value is taken to hold",
                              actuator, channel, std::max({longest_s, late_s, early_s})));
}

std::string output_name(std::size_t place) { return fmt::format("output{}", place); }

std::string_view unit_name(config::CommandUnit unit) {
  return base::enum_name<config::CommandUnit::microseconds>(unit, {"rpm", "%", "us"});
}

}  // namespace

ActuatorTrajectory::ActuatorTrajectory(const config::Layout& layout, std::size_t rows)
    : columns_(layout.thrusters.size() + layout.surfaces.size() + layout.ballasts.size() +
               layout.moving_masses.size()),
      rows_(rows), values_(columns_ * rows), integrals_(columns_ * rows) {}

void ActuatorTrajectory::set(std::size_t row, const sim::ActuatorValues& positions) {
  std::size_t i = row * columns_;
  for (const auto* part :
       {&positions.thrusters, &positions.surfaces_rad, &positions.ballasts_N, &positions.masses_m}) {
    for (const double value : *part) {
      values_[i] = value;
      if (row > 0) integrals_[i] = integrals_[i - columns_] + kStep_s / 2 * (values_[i - columns_] + value);
      ++i;
    }
  }
}

void ActuatorTrajectory::at(double time_s, sim::ActuatorValues& out) const {
  const double place = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(rows_ - 1));
  const std::size_t row = std::min(static_cast<std::size_t>(place), rows_ - 1);
  const double part = place - static_cast<double>(row);
  const double* a = values_.data() + row * columns_;
  const double* b = row + 1 < rows_ ? a + columns_ : a;
  for (auto* values : {&out.thrusters, &out.surfaces_rad, &out.ballasts_N, &out.masses_m}) {
    for (double& value : *values) {
      value = *a + part * (*b - *a);
      ++a;
      ++b;
    }
  }
}

void ActuatorTrajectory::add_integrals(double time_s, double factor, sim::ActuatorValues& out) const {
  const double within_s = std::clamp(time_s, 0.0, end_s());
  const std::size_t row = std::min(static_cast<std::size_t>(within_s / kStep_s), rows_ - 1);
  const double past_s = within_s - kStep_s * static_cast<double>(row);
  std::size_t i = row * columns_;
  const std::size_t next = row + 1 < rows_ ? columns_ : 0;
  // Before and after the grid its ends hold.
  const double outside_s = time_s - within_s;
  for (auto* values : {&out.thrusters, &out.surfaces_rad, &out.ballasts_N, &out.masses_m}) {
    for (double& value : *values) {
      const double slope = (values_[i + next] - values_[i]) / kStep_s;
      value += factor * (integrals_[i] + past_s * (values_[i] + past_s / 2 * slope) + outside_s * values_[i]);
      ++i;
    }
  }
}

void ActuatorTrajectory::mean(double time_s, double over_s, sim::ActuatorValues& out) const {
  for (auto* values : {&out.thrusters, &out.surfaces_rad, &out.ballasts_N, &out.masses_m})
    std::fill(values->begin(), values->end(), 0.0);
  add_integrals(time_s + over_s, 1 / over_s, out);
  add_integrals(time_s, -1 / over_s, out);
}

std::vector<std::string> signals_of_thruster(const config::Layout& layout, std::size_t thruster) {
  const config::LayoutThruster& of = layout.thrusters[thruster];
  if (!of.channel.empty()) return {of.channel};
  if (of.unit != config::CommandUnit::rpm) return {output_name(thruster + 1)};
  if (layout.thrusters.size() > 1) return {fmt::format("rpm{}", thruster + 1)};
  return {"rpm", "rpm_commanded"};
}

std::vector<std::string> signals_of_surface(const config::Layout& layout, std::size_t surface) {
  const config::LayoutSurface& of = layout.surfaces[surface];
  if (of.limit_rad == 0) return {};
  if (!of.channel.empty()) return {of.channel};
  const auto movable =
      std::count_if(layout.surfaces.begin(), layout.surfaces.begin() + static_cast<std::ptrdiff_t>(surface),
                    [](const config::LayoutSurface& before) { return before.limit_rad > 0; });
  return {fmt::format("fin_{}", movable + 1)};
}

bool is_position(const RecordedMotion& motion, const std::string& signal) {
  return signal == "rpm" || (signal.starts_with("fin_") && motion.fins_are_reported);
}

ActuatorInputs::Input ActuatorInputs::input_of(const std::string& actuator, std::vector<std::string> wanted,
                                               const std::string& by_place, const sim::PulseRange& range) {
  const std::size_t usual = wanted.size();
  if (!by_place.empty() && std::ranges::count(wanted, by_place) == 0) wanted.push_back(by_place);
  for (const std::string& name : wanted) {
    const auto found = motion_.signals.find(name);
    if (found == motion_.signals.end() || found->second.empty()) continue;
    are_by_place_ = are_by_place_ || (wanted.size() > usual && name == wanted.back());
    Input input{&found->second, is_position(motion_, name), name, nullptr};
    if (input.signal->is_pulse && !range.is_pulse) {
      auto commands = std::make_shared<Signal>(*input.signal);
      commands->is_pulse = false;
      for (double& value : commands->values) value = range.command(value);
      input.signal = commands.get();
      input.converted = std::move(commands);
    }
    return input;
  }
  std::string names, there;
  for (const std::string& name : wanted) names += (names.empty() ? "" : " or ") + name;
  for (const auto& [name, signal] : motion_.signals) there += (there.empty() ? "" : ", ") + name;
  if (!wanted.empty())
    missing_.push_back(fmt::format("commands are missing: {} needs {}; the recording has {}", actuator, names,
                                   there.empty() ? "no commands" : there));
  return {};
}

ActuatorInputs::ActuatorInputs(const config::Layout& layout, const RecordedMotion& motion) : motion_(motion) {
  const std::vector<sim::PulseRange> ranges = sim::pulse_ranges(layout);
  bool has_each_output = !motion.signals.contains(output_name(ranges.size() + 1));
  for (std::size_t place = 1; place <= ranges.size(); ++place)
    has_each_output = has_each_output && motion.signals.contains(output_name(place));
  std::size_t place = 0;
  const auto next = [&](const std::string& actuator, std::vector<std::string> wanted, const std::string& channel) {
    ++place;
    const std::string by_place = has_each_output && channel.empty() ? output_name(place) : "";
    return input_of(actuator, std::move(wanted), by_place, ranges[place - 1]);
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const config::LayoutThruster& of = layout.thrusters[i];
    thrusters_.push_back(next("thruster " + of.name, signals_of_thruster(layout, i), of.channel));
  }
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) {
    const config::LayoutSurface& of = layout.surfaces[i];
    surfaces_.push_back(next("surface " + of.name, signals_of_surface(layout, i), of.channel));
  }
  const auto of_channel = [&](const std::string& channel, const char* usual) {
    if (channel.empty() && motion.signals.count(usual) == 0) return std::vector<std::string>{};
    return std::vector<std::string>{channel.empty() ? usual : channel};
  };
  for (const auto& of : layout.ballasts)
    ballasts_.push_back(next("ballast " + of.name, of_channel(of.channel, "ballast"), of.channel));
  for (const auto& of : layout.moving_masses)
    masses_.push_back(next("moving mass " + of.name, of_channel(of.channel, "moving_mass"), of.channel));
}

template <class Is>
bool ActuatorInputs::has_any(Is is) const {
  return std::ranges::any_of(std::array{&thrusters_, &surfaces_, &ballasts_, &masses_}, [&](const auto* inputs) {
    return std::any_of(inputs->begin(), inputs->end(),
                       [&](const Input& input) { return input.signal != nullptr && is(input); });
  });
}

bool ActuatorInputs::follow_commands() const {
  return has_any([](const Input& input) { return !input.is_position; });
}

bool ActuatorInputs::use(const std::string& signal) const {
  return has_any([&](const Input& input) { return input.name == signal; });
}

std::vector<std::string> ActuatorInputs::oddities(const config::Layout& layout) const {
  std::vector<std::string> words;
  if (are_by_place_)
    words.emplace_back(
        "pulses are taken for commands of the layout's actuators, in its order: 1100 us for the lower limit, 1500 "
        "for neutral, 1900 for the upper limit");
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const config::LayoutThruster& thruster = layout.thrusters[i];
    if (thrusters_[i].signal != nullptr)
      add_oddities("thruster " + thruster.name, thrusters_[i].name, *thrusters_[i].signal,
                   {thruster.low, thruster.high, std::string(unit_name(thruster.unit))}, motion_.duration_s,
                   words);
  }
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) {
    const config::LayoutSurface& surface = layout.surfaces[i];
    if (surfaces_[i].signal != nullptr)
      add_oddities("surface " + surface.name, surfaces_[i].name, *surfaces_[i].signal,
                   {-surface.limit_rad, surface.limit_rad, "deg", base::kRadiansPerDegree}, motion_.duration_s,
                   words);
  }
  return words;
}

ActuatorTrajectory ActuatorInputs::trajectory(const config::Layout& layout) const {
  const auto rows = static_cast<std::size_t>(std::ceil(motion_.duration_s / ActuatorTrajectory::kStep_s)) + 3;
  ActuatorTrajectory trajectory(layout, rows);
  config::Layout soft = layout;
  for (config::LayoutThruster& thruster : soft.thrusters) {
    if (thruster.dead_band > 0)
      thruster.dead_band_edge = std::min(thruster.dead_band, kSoftEdge * (thruster.high - thruster.low) / 2);
  }
  // Where a card reported all fins: angles between its reports by the servo's lag
  // (gap/actuators/actuator_track.h).
  std::optional<gap::ActuatorTrack> track;
  const bool reports_fins =
      !motion_.order_times_s.empty() && surfaces_.size() == 3 &&
      std::all_of(surfaces_.begin(), surfaces_.end(), [&](const Input& input) {
        return input.is_position && input.signal->times_s == surfaces_.front().signal->times_s;
      });
  if (reports_fins) {
    std::vector<gap::MotorReading> readings;
    const auto& fins = surfaces_;
    for (std::size_t i = 0; i < fins[0].signal->times_s.size(); ++i)
      readings.push_back({fins[0].signal->times_s[i],
                          0,
                          {fins[0].signal->values[i], fins[1].signal->values[i], fins[2].signal->values[i]},
                          0});
    track.emplace(readings, motion_.order_times_s, motion_.ordered_fins_rad, layout.surfaces[0].lag_s,
                  devices::MotorModel{}, motion_.duration_s);
  }
  std::vector<std::size_t> at(thrusters_.size() + surfaces_.size() + ballasts_.size() + masses_.size());
  sim::ActuatorValues commands = sim::ActuatorValues::neutral(layout), positions = commands;
  const auto read = [&](double time_s, bool positions_only) {
    std::size_t n = 0;
    const auto take = [&](const std::vector<Input>& inputs, sim::ActuatorNumbers& command,
                          sim::ActuatorNumbers& position) {
      for (std::size_t i = 0; i < inputs.size(); ++i, ++n) {
        if (inputs[i].signal == nullptr) continue;
        if (inputs[i].is_position) {
          position[i] = linear_at(*inputs[i].signal, time_s, at[n]);
        } else if (!positions_only) {
          command[i] = held_at(*inputs[i].signal, time_s, at[n]);
        }
      }
    };
    take(thrusters_, commands.thrusters, positions.thrusters);
    take(surfaces_, commands.surfaces_rad, positions.surfaces_rad);
    take(ballasts_, commands.ballasts_N, positions.ballasts_N);
    take(masses_, commands.masses_m, positions.masses_m);
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const double time_s = ActuatorTrajectory::kStep_s * static_cast<double>(row);
    // The command of the middle of the step leads to its end.
    read(time_s - ActuatorTrajectory::kStep_s / 2, false);
    if (row > 0) positions = sim::follow(soft, positions, commands, ActuatorTrajectory::kStep_s);
    read(time_s, true);
    if (track) {
      const auto& fins_rad = track->rows()[std::min(row, track->rows().size() - 1)].fins_rad;
      std::copy(fins_rad.begin(), fins_rad.end(), positions.surfaces_rad.begin());
    }
    trajectory.set(row, positions);
  }
  return trajectory;
}

}  // namespace navcal::identify
