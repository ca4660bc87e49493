// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/layout_rehearser.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "base/vectors.h"
#include "identify/data/actuator_inputs.h"
#include "identify/replay/predicted_readings.h"
#include "sim/layout/control/layout_mission_helm.h"
#include "sim/layout/pulses.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::diagnosis {
namespace {

using identify::Channel;
using identify::RecordedMotion;
using identify::Signal;

/// The readings of a channel: when they come, and their noise.
struct Sampling {
  double first_s = 0, interval_s = 1, std = 0;
};

Sampling sampling_of(const std::vector<identify::Reading>& readings) {
  std::vector<double> intervals_s, stds;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    stds.push_back(readings[i].std);
    if (i > 0) intervals_s.push_back(readings[i].time_s - readings[i - 1].time_s);
  }
  const double interval_s = intervals_s.empty() ? 1 : std::max(base::median(intervals_s), 0.01);
  return {std::fmod(readings.front().time_s, interval_s), interval_s, base::median(stds)};
}

/// Depth down to which a recording has fixes, with some more for waves; infinite where it has no depth.
double deepest_fix_m(const RecordedMotion& like) {
  constexpr double kWaves_m = 0.2;
  const auto& depths = like.has(Channel::depth) ? like[Channel::depth] : like[Channel::gauge_depth];
  if (depths.empty()) return std::numeric_limits<double>::infinity();
  double deepest_m = 0;
  for (const identify::Reading& fix : like[Channel::north]) {
    const auto next =
        std::lower_bound(depths.begin(), depths.end(), fix.time_s,
                         [](const identify::Reading& one, double time_s) { return one.time_s < time_s; });
    deepest_m = std::max(deepest_m, (next == depths.end() ? depths.back() : *next).value);
  }
  return deepest_m + kWaves_m;
}

/// The motion of a state, with the acceleration that its specific force means.
identify::MotionPoint point_of(const sim::SimulatedMotion& motion, double time_s) {
  constexpr double kHalf_s = 0.01;
  const auto state_at = [&](double at_s) { return motion.at(std::llround(at_s * 1e9)); };
  using base::vector_of;
  const sim::State state = state_at(time_s);
  identify::MotionPoint point;
  point.body.position_m = vector_of(state.position_m);
  point.body.euler_rad = vector_of(state.euler_rad);
  point.body.velocity << vector_of(state.velocity_body_m_s), vector_of(state.rate_rad_s);
  const Eigen::Vector3d omega = vector_of(state.rate_rad_s);
  const double from_s = std::max(time_s - kHalf_s, 0.0);
  point.acceleration << vector_of(state.specific_force_m_s2) - omega.cross(vector_of(state.velocity_body_m_s)) +
                            base::kGravity_m_s2 *
                                identify::world_from_body(point.body.euler_rad).row(2).transpose(),
      (vector_of(state_at(time_s + kHalf_s).rate_rad_s) - vector_of(state_at(from_s).rate_rad_s)) /
          (time_s + kHalf_s - from_s);
  return point;
}

/// The orders to a vehicle under way, as a recording like `like` has them.
void add_orders(const config::Layout& layout, const RecordedMotion& like, double time_s,
                const std::vector<double>& pulses_us, const sim::ActuatorValues& positions,
                RecordedMotion& sailed) {
  const sim::ActuatorValues commands = sim::commands_of(layout, pulses_us);
  std::size_t output = 0;
  const auto add = [&](const std::vector<std::string>& names, double command, double position) {
    const double pulse_us = pulses_us[output++];
    const auto recorded =
        std::find_if(names.begin(), names.end(), [&](const auto& name) { return like.signals.contains(name); });
    if (recorded == names.end()) return;
    Signal& signal = sailed.signals[*recorded];
    signal.is_pulse = like.signals.at(*recorded).is_pulse;
    const bool is_position = identify::is_position(like, *recorded);
    signal.times_s.push_back(time_s);
    signal.values.push_back(signal.is_pulse ? pulse_us : is_position ? position : command);
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    add(identify::signals_of_thruster(layout, i), commands.thrusters[i], positions.thrusters[i]);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i)
    add(identify::signals_of_surface(layout, i), commands.surfaces_rad[i], positions.surfaces_rad[i]);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i)
    add({layout.ballasts[i].channel, "ballast"}, commands.ballasts_N[i], positions.ballasts_N[i]);
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i)
    add({layout.moving_masses[i].channel, "moving_mass"}, commands.masses_m[i], positions.masses_m[i]);
}

}  // namespace

config::Layout LayoutRehearser::with(const config::Layout& layout, const Eigen::VectorXd& departures) const {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(library_.columns());
  start.head(std::ssize(library_.parameters)) = identify::prior_values(library_.parameters);
  return identify::with_values(layout, library_.parameters,
                               values_within(library_, start, departures).head(std::ssize(library_.parameters)));
}

gap::Regime LayoutRehearser::regime(const config::MissionLimits& limits) const {
  config::Mission straight;
  straight.steps.push_back({.kind = config::StepKind::leg, .seconds = 1});
  try {
    gap::Regime regime = gap::regime_of(sim::LayoutMissionHelm(layout_, straight).plan().greatest_m_s, limits);
    // Without a receiver nothing is to be had at the surface.
    regime.surfaces &= like_.has(Channel::north);
    return regime;
  } catch (const sim::UnfitLayout& error) {
    throw std::invalid_argument(error.what());
  }
}

bool LayoutRehearser::can(const config::Mission& mission) const {
  try {
    const sim::LayoutMissionHelm helm(layout_, mission);
    return true;
  } catch (const sim::UnfitLayout&) {
    return false;
  }
}

gap::PlannedPath LayoutRehearser::path(const config::Mission& mission, double longest_s,
                                       const gap::Hypothesis* changed) const {
  // The autopilot knows the nominal vehicle.
  auto helm = std::make_unique<sim::LayoutMissionHelm>(layout_, gap::once(mission));
  const sim::LayoutMissionHelm& under_way = *helm;
  const config::Layout sails = changed == nullptr ? layout_ : with(layout_, change_of_(*changed));
  try {
    const sim::SimulatedMotion motion(sails, std::move(helm), {.history_s = 20});
    gap::PlannedPath path = gap::path_of(
        motion, [&] { return under_way.finished(); }, longest_s);
    path.step_began_s = under_way.step_began_s();
    path.has_card = false;
    return path;
  } catch (const sim::UnfitLayout& error) {
    throw sim::UnstableVehicle(error.what());
  }
}

RecordedMotion LayoutRehearser::sailed(const config::Mission& mission, double duration_s) const {
  RecordedMotion sailed = like_;
  sailed.name = "the mission planned";
  sailed.channels = {};
  sailed.signals.clear();
  sailed.order_times_s.clear();
  sailed.ordered_fins_rad.clear();
  sailed.duration_s = duration_s;
  const sim::SimulatedMotion motion(layout_, std::make_unique<sim::LayoutMissionHelm>(layout_, gap::once(mission)),
                                    {.history_s = 20});
  std::array<Sampling, identify::kChannels> sampling;
  std::array<double, identify::kChannels> next_s;
  next_s.fill(std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    if (like_.channels[c].empty()) continue;
    sampling[c] = sampling_of(like_.channels[c]);
    next_s[c] = sampling[c].first_s;
  }
  const double deepest_m = deepest_fix_m(like_);
  const identify::PredictedReadings predicted(like_);
  const identify::Calibration perfect = identify::Calibration::Zero();
  Eigen::Vector2d tilt_rad = point_of(motion, 0).body.euler_rad.head<2>(), before_rad = tilt_rad;
  double before_s = 0;
  std::vector<sim::OutputOrder> orders;
  for (double time_s = 0; time_s < duration_s;) {
    const auto next = std::min_element(next_s.begin(), next_s.end());
    const auto channel = static_cast<Channel>(next - next_s.begin());
    time_s = std::min(*next, duration_s);
    identify::MotionPoint point = point_of(motion, time_s);
    const Eigen::Vector2d true_rad = point.body.euler_rad.head<2>();
    if (time_s > before_s)
      tilt_rad = identify::lagged_tilt(tilt_rad, before_rad, true_rad, like_.tilt_lag_s, time_s - before_s);
    before_rad = true_rad;
    before_s = time_s;
    point.tilt_rad = tilt_rad;
    orders.clear();
    motion.take_outputs(std::llround(time_s * 1e9), orders);
    for (const sim::OutputOrder& order : orders)
      add_orders(layout_, like_, static_cast<double>(order.time_ns) * 1e-9, order.pulses_us, motion.positions(),
                 sailed);
    if (time_s >= duration_s) break;
    const auto c = static_cast<std::size_t>(channel);
    *next += sampling[c].interval_s;
    if (channel >= Channel::north && point.body.position_m.z() > deepest_m) continue;
    double value = 0;
    const identify::ChannelReading reading{channel, time_s, 0, sampling[c].std};
    predicted.at(point, Eigen::Vector3d::Zero(), {&reading, 1}, perfect, &value);
    sailed.channels[c].push_back({time_s, value, sampling[c].std});
  }
  return sailed;
}

gap::Rehearsal LayoutRehearser::rehearse(const config::Mission& mission, double duration_s,
                                         std::span<const double> part_began_s) const {
  const RecordedMotion motion = sailed(mission, duration_s);
  const auto model = source_.fitted(motion);
  const auto linear = model->linearised(nominal_);
  if (!linear) throw cannot_follow(motion);
  const Eigen::Index n = library_.columns();
  gap::Rehearsal rehearsal{linear->information(), {}};
  rehearsal.parts.assign(part_began_s.size(), Eigen::MatrixXd::Zero(n, n));
  const auto& readings = model->filter().readings();
  for (std::size_t from = 0; from < readings.size();) {
    const std::ptrdiff_t part = gap::part_at(part_began_s, readings[from].time_s);
    std::size_t until = from + 1;
    while (until < readings.size() && gap::part_at(part_began_s, readings[until].time_s) == part) ++until;
    const auto rows =
        linear->jacobian.middleRows(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(until - from));
    if (part >= 0) rehearsal.parts[static_cast<std::size_t>(part)].noalias() += rows.transpose() * rows;
    from = until;
  }
  return rehearsal;
}

}  // namespace navcal::diagnosis
