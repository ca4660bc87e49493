// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/swim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "validation/reference/thrusters/craft.h"

namespace navcal::reference::thrusters {
namespace {

constexpr double kDamping = 0.9;
constexpr double kHeadingPace_rad_s = 1.5, kTiltPace_rad_s = 2.5, kDepthPace_rad_s = 0.6;
constexpr double kSmoothing_s = 0.3;
constexpr double kGreatestPitch_rad = 35 * kDegree;
constexpr double kDoublet_s = 1;
constexpr double kTiltMemory_s = 2;
constexpr double kNear_m = 0.3;  ///< from the depth that is wanted: only there its error is summed

double turned(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

Eigen::Index at(std::size_t axis) { return static_cast<Eigen::Index>(axis); }

constexpr double kOutputLatency_s = 0.005;
constexpr double kGreatestTilt_rad = 75 * kDegree;
constexpr double kHighest_m = -1;
constexpr std::uint64_t kSeaStream = 1001;

void check(const Swim& swim) {
  if (!std::isfinite(swim.duration_s) || swim.duration_s < 0)
    throw std::invalid_argument("a mission lasts a finite time, not less than none");
  double last_s = 0;
  for (const Leg& leg : swim.legs) {
    if (!(leg.from_s >= last_s)) throw std::invalid_argument("legs are not in order of time");
    last_s = leg.from_s;
  }
}

bool is_well(const Craft& craft, const Snapshot& now, double floor_m) {
  return craft.finite() && std::abs(now.roll_rad()) < kGreatestTilt_rad &&
         std::abs(now.pitch_rad()) < kGreatestTilt_rad && now.position_m.z() > kHighest_m &&
         now.position_m.z() < floor_m - 1;
}

Sea sea_of(const Swim& swim, const CraftUnderTest& craft, std::uint64_t seed) {
  Rng dice(seed, kSeaStream);
  Sea sea(swim.anchorage.latitude_deg * kDegree, craft.nature.current_m_s, craft.nature.wave_m, dice);
  sea.set_current(craft.differences.instruments.vehicle.current_m_s);
  return sea;
}

/// The vehicle's computer: pilot, outputs, and the lines in which it reports them.
class Computer {
 public:
  Computer(const Plan& layout, const Swim& swim, std::uint64_t seed, double host_delay_s)
      : layout_(layout), legs_(swim.legs), start_ns_(swim.start_ns),
        pilot_(layout, std::atan2(swim.waters.field_uT.y(), swim.waters.field_uT.x())),
        dice_(seed, static_cast<std::uint64_t>(Port::actuators)), host_delay_s_(host_delay_s) {}

  void steer(double time_s, const Compass::Reading& compass, const Card::Reading& card, Craft& craft,
             std::vector<Transfer>& out) {
    while (following_ < legs_.size() && legs_[following_].from_s <= time_s + 1e-9) ++following_;
    if (following_ == 0) return;
    const std::vector<int> pulses = pilot_.steer(legs_[following_ - 1], time_s, compass, card);
    std::vector<double> commands;
    for (std::size_t i = 0; i < pulses.size(); ++i)
      commands.push_back(command_of(layout_.thrusters[i], pulses[i]));
    craft.order(commands);
    std::vector<std::uint8_t> line = output_line(pulses);
    const double wire_s = 10.0 * static_cast<double>(line.size()) / facts_of(Port::actuators).baud;
    const double read_s = time_s + kOutputLatency_s + wire_s + dice_.exponential(host_delay_s_);
    out.push_back({Port::actuators, false, start_ns_ + std::llround(read_s * 1e9), std::move(line)});
  }

 private:
  const Plan& layout_;
  const std::vector<Leg>& legs_;
  std::int64_t start_ns_;
  Pilot pilot_;
  Rng dice_;
  double host_delay_s_;
  std::size_t following_ = 0;
};

}  // namespace

Pilot::Pilot(const Plan& plan, double variation_rad)
    : allocator_(plan), inertia_(inertia(plan).diagonal()),
      sinking_N_(plan.mass_kg * kGravity_m_s2 - plan.buoyancy_N), variation_rad_(variation_rad) {}

double Pilot::held(std::size_t axis, double error_rad, double rate_rad_s, double pace_rad_s) const {
  const double wanted = inertia_(at(axis)) * pace_rad_s * (pace_rad_s * error_rad - 2 * kDamping * rate_rad_s);
  return std::clamp(wanted, -allocator_.limit(axis), allocator_.limit(axis));
}

void Pilot::observe_tilt(const Compass::Reading& compass, const Card::Reading& card) {
  roll_rad_ += kPeriod_s * (card.roll_rate_rad_s + (compass.roll_rad - roll_rad_) / kTiltMemory_s);
  pitch_rad_ += kPeriod_s * (card.pitch_rate_rad_s + (compass.pitch_rad - pitch_rad_) / kTiltMemory_s);
}

void Pilot::steer_depth(const Leg& leg, const Card::Reading& card, Wrench& wanted) {
  if (!smooth_depth_m_) smooth_depth_m_ = card.depth_m;
  const double change_m = (card.depth_m - *smooth_depth_m_) * (kPeriod_s / kSmoothing_s);
  *smooth_depth_m_ += change_m;
  sinking_m_s_ += (change_m / kPeriod_s - sinking_m_s_) * (kPeriod_s / kSmoothing_s);
  const double error_m = std::clamp(leg.depth_m - card.depth_m, -2.0, 2.0);
  double pitch_rad = 0;
  if (allocator_.commands(2)) {
    if (std::abs(error_m) < kNear_m) depth_sum_ = std::clamp(depth_sum_ + error_m * kPeriod_s, -4.0, 4.0);
    const double force =
        inertia_(2) *
        (kDepthPace_rad_s * (kDepthPace_rad_s * error_m - 2 * kDamping * sinking_m_s_) + 0.05 * depth_sum_);
    wanted(2) = std::clamp(force - sinking_N_, -allocator_.limit(2), allocator_.limit(2));
  } else {
    depth_sum_ = std::clamp(depth_sum_ + error_m * kPeriod_s, -3.0, 3.0);
    pitch_rad = std::clamp(-0.6 * (error_m + 0.1 * depth_sum_), -kGreatestPitch_rad, kGreatestPitch_rad);
  }
  if (allocator_.commands(4)) wanted(4) = held(4, pitch_rad - pitch_rad_, card.pitch_rate_rad_s, kTiltPace_rad_s);
}

std::vector<int> Pilot::steer(const Leg& leg, double time_s, const Compass::Reading& compass,
                              const Card::Reading& card) {
  Wrench wanted = Wrench::Zero();
  observe_tilt(compass, card);
  steer_depth(leg, card, wanted);
  if (allocator_.commands(3)) wanted(3) = held(3, -roll_rad_, card.roll_rate_rad_s, kTiltPace_rad_s);
  const double heading_error = turned(leg.heading_rad - compass.heading_rad - variation_rad_);
  wanted(5) = held(5, std::clamp(heading_error, -0.8, 0.8), card.yaw_rate_rad_s, kHeadingPace_rad_s);
  wanted(0) = leg.surge * allocator_.limit(0);
  wanted(1) = leg.sway * allocator_.limit(1);
  const double into_s = time_s - leg.from_s - leg.doublet_s;
  if (into_s >= 0 && into_s < 2 * kDoublet_s) {
    const double sense = into_s < kDoublet_s ? 1 : -1;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const double force = sense * leg.doublet(at(axis)) * inertia_(at(axis));
      wanted(at(axis)) += std::clamp(force, -allocator_.limit(axis), allocator_.limit(axis));
    }
  }
  return allocator_.pulses_us(wanted);
}

std::optional<Lost> run(const Swim& swim, const CraftUnderTest& specimen, std::uint64_t seed, Sink& sink) {
  check(swim);
  const Differences& differences = specimen.differences;
  const ParameterDeviations& instruments = differences.instruments;
  const Fitting fitting{seed, specimen.noisy, swim.start_ns};
  Craft craft(specimen.real, differences.craft, specimen.nature, sea_of(swim, specimen, seed), swim.start);
  History history(craft.snapshot(), Craft::kStep_s,
                  std::max(instruments.card.latency_s, instruments.gps.latency_s) + 1, swim.waters.surface_C);
  Compass compass(fitting.with_clock(specimen.compass_clock), instruments.compass, swim.waters.field_uT);
  Card card(fitting.with_clock(specimen.card_clock), instruments.card);
  Receiver receiver(fitting, instruments.gps, swim.anchorage);
  Doppler doppler(fitting, specimen.doppler, swim.floor_m);
  Computer computer(specimen.layout, swim, seed, fitting.host_delay_s);
  Outbox outbox(sink);

  const auto ticks = static_cast<std::int64_t>(std::floor(swim.duration_s / Pilot::kPeriod_s + 1e-9));
  const auto steps = std::llround(Pilot::kPeriod_s / Craft::kStep_s);
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    const Snapshot now = history.now();
    sink.truth(now);
    const double time_s = static_cast<double>(tick) * Pilot::kPeriod_s;
    computer.steer(time_s, compass.reading(), card.reading(), craft, outbox.waiting());
    for (long long i = 1; i <= steps; ++i) {
      craft.advance(time_s + static_cast<double>(i) * Craft::kStep_s);
      history.remember(craft.snapshot());
    }
    if (!is_well(craft, history.now(), swim.floor_m)) return Lost{time_s, now};
    for (Instrument* instrument : std::initializer_list<Instrument*>{&compass, &card, &receiver, &doppler})
      instrument->catch_up(history, outbox.waiting());
    outbox.hand_over(swim.start_ns + std::llround(history.now().time_s * 1e9));
  }
  sink.truth(history.now());
  outbox.hand_over(std::numeric_limits<std::int64_t>::max());
  return std::nullopt;
}

std::vector<Leg> drawn_legs(const Plan& layout, double duration_s, Rng& dice) {
  constexpr double kAtSurface_s = 14, kShortest_s = 6, kLongest_s = 10;
  constexpr double kFloating_m = 0.3, kShallow_m = 1, kDeep_m = 4;
  const Allocator allocator(layout);
  const bool hovers = allocator.commands(2);
  const double cruise = hovers ? 0 : 0.4;                  // what has no thruster downwards needs way to dive
  constexpr double kPush_m_s2 = 0.6, kTwist_rad_s2 = 1.2;  // of doublets, at most
  Leg leg;
  leg.from_s = 0.3;  // each instrument has spoken
  leg.heading_rad = dice.uniform(0, 2 * std::numbers::pi);
  leg.depth_m = kFloating_m;
  leg.surge = hovers ? 0 : 0.2;
  std::vector<Leg> legs{leg};
  double time_s = kAtSurface_s;
  std::size_t axis = 0;
  while (time_s < duration_s - kAtSurface_s - kLongest_s) {
    leg.from_s = time_s;
    leg.heading_rad = std::remainder(leg.heading_rad + dice.uniform(-1.6, 1.6), 2 * std::numbers::pi);
    leg.depth_m = dice.uniform(kShallow_m, kDeep_m);
    leg.surge = hovers ? dice.uniform(-0.35, 0.35) : dice.uniform(cruise, 0.8);
    leg.sway = allocator.commands(1) ? dice.uniform(-0.25, 0.25) : 0;
    leg.doublet.setZero();
    leg.doublet_s = dice.uniform(1, 3);
    do axis = (axis + 1) % kAxes;
    while (!allocator.commands(axis));
    const double greatest = axis < 3 ? kPush_m_s2 : kTwist_rad_s2;
    leg.doublet(static_cast<Eigen::Index>(axis)) =
        (dice.uniform() < 0.5 ? -1 : 1) * dice.uniform(0.4, 1) * greatest;
    legs.push_back(leg);
    time_s += dice.uniform(kShortest_s, kLongest_s);
  }
  leg.from_s = time_s;
  leg.depth_m = kFloating_m;
  leg.surge = cruise;
  leg.sway = 0;
  leg.doublet.setZero();
  legs.push_back(leg);
  return legs;
}

}  // namespace navcal::reference::thrusters
