// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_mission.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"
#include "gap/actuators/commanded_motor.h"
#include "gap/actuators/trajectory_tracker.h"
#include "gap/thresholds.h"
#include "sim/effects/effect_table.h"
#include "sim/motion_in_field.h"
#include "sim/noise.h"
#include "sim/recording.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::gap {
namespace {

/// 2026-01-01; any full second would serve.
constexpr std::int64_t kSomeSecond_ns = 1'767'225'600 * base::kSecond_ns;
/// A receiver's noise is settled after so many fixes.
constexpr int kPoorFixes = 8;

config::Settings simulated_settings(const devices::InstrumentModel& instruments) {
  config::Settings settings;
  settings.ports = sim::recording_ports(instruments);
  return samples_only(settings);
}

/// The noise of the first fixes of each surfacing, as the nominal receiver has it.
void add_surfacings(const Mission& recorded, sim::EffectSet& effects) {
  for (const FixReading& fix : recorded.fixes) {
    if (fix.number >= kPoorFixes) continue;
    const std::array<double, 4> more{0, 0, devices::GpsModel::excess_noise(fix.number), 0};
    effects.add(sim::make_effect("noise_level"), {fix.time_s - 0.5, fix.time_s + 0.5}).set_parameters(more);
  }
}

/// Keeps only the fixes that the recorded mission had, with their numbers.
void keep_fixes(const Mission& recorded, Mission& simulated) {
  std::vector<FixReading> kept;
  auto next = simulated.fixes.begin();
  for (const FixReading& fix : recorded.fixes) {
    while (next != simulated.fixes.end() && next->time_s < fix.time_s - 0.5) ++next;
    if (next == simulated.fixes.end()) break;
    if (next->time_s > fix.time_s + 0.5) continue;
    kept.push_back(*next);
    kept.back().number = fix.number;
    ++next;
  }
  simulated.fixes = std::move(kept);
}

}  // namespace

Mission null_mission(const RepeatedMission& repeated, const sim::EffectSet& mismatch, std::uint64_t seed) {
  const auto& [recorded, course, vehicle] = repeated;
  // The simulated receiver fixes at full seconds: the begin is shifted so that they coincide with the recorded
  // fixes.
  const auto& fixes = recorded.mission().fixes;
  const double phase_s = fixes.empty() ? 0 : fixes.front().time_s - std::floor(fixes.front().time_s);
  const std::int64_t begin_ns = kSomeSecond_ns - std::llround(phase_s * 1e9);

  sim::EffectSet effects(begin_ns);
  for (std::size_t i = 0; i < mismatch.size(); ++i) effects.add(mismatch[i].clone());
  add_surfacings(recorded.mission(), effects);
  effects.reseed(seed);
  // The phase between the card's reports and the orders is random.
  sim::Noise dice(seed);
  const double later_s = dice.uniform(0, kInterval_s);
  const auto& track = recorded.actuators();
  auto helm = std::make_unique<TrajectoryTracker>(
      track.rows(), track.orders().drawn_servos_rad(track.rows().size(), ActuatorTrack::kStep_s, later_s, dice),
      course, vehicle.fins);
  const EarthField& field = recorded.mission().field;
  const sim::MotionInField motion(
      std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), sim::MotionOptions{begin_ns, &effects, 20}),
      field.north_east_down_uT);
  sim::Recording::Options options{begin_ns, true, seed, &effects, false, true};
  options.instruments = recorded.mission().instruments;
  sim::Recording instruments(options, motion);

  pipeline::Pipeline pipeline(simulated_settings(options.instruments));
  MissionGatherer gatherer;
  std::vector<sim::LineRead> reads;
  const std::int64_t end_ns = begin_ns + std::llround(recorded.mission().duration_s * 1e9);
  for (std::int64_t t_ns = begin_ns; t_ns < end_ns;) {
    t_ns = std::min(t_ns + base::kSecond_ns, end_ns);
    reads.clear();
    instruments.advance(t_ns, reads);
    for (const sim::LineRead& read : reads) {
      if (!read.sent) pipeline.bytes(static_cast<std::uint16_t>(read.of), read.time_ns, read.bytes, gatherer);
    }
  }
  Mission mission = gatherer.take(begin_ns, {});
  mission.instruments = options.instruments;
  silence_like(recorded.mission(), mission);
  // A fitted field absorbs some of each vehicle's tolerances, so it is fitted to each null, too.
  mission.field = field.source == EarthField::Source::fitted ? fitted_field(mission.compass) : field;
  keep_fixes(recorded.mission(), mission);
  for (const double time_s : track.orders().order_times_s()) mission.order_times_s.push_back(time_s + later_s);
  if (recorded.mission().motor_is_commanded) {
    for (Order order : recorded.mission().orders) {
      order.time_s += later_s;
      mission.orders.push_back(order);
    }
    mission.motor.clear();
    obey_orders(mission, vehicle);
    mission.order_times_s.clear();
    for (const Order& order : mission.orders) {
      mission.order_times_s.push_back(order.time_s);
      mission.ordered_fins_rad.push_back(order.fins_rad);
    }
  }
  return mission;
}

Eigen::VectorXd benign_mismatch(const Library& library, std::uint64_t seed) {
  sim::Noise noise(seed);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  for (Eigen::Index j = Library::kBiases; j < values.size(); ++j) {
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    const double drawn = noise.normal(kTolerance * unknown.typical);
    values[j] = unknown.least >= 0 ? std::abs(drawn) : drawn;
  }
  return values;
}

}  // namespace navcal::gap
