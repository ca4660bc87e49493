// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_mission.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "autopilot/autopilot.h"
#include "base/angles.h"
#include "base/durations.h"
#include "base/vectors.h"
#include "config/vehicle.h"
#include "gap/actuators/actuator_track.h"
#include "gap/actuators/commanded_motor.h"
#include "gap/data/innovations.h"
#include "gap/data/simulated_mission.h"
#include "gap/thresholds.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/layout_of.h"
#include "sim/noise.h"
#include "sim/vehicle/helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::gap {
namespace {

// Weak gains, so that the motion follows from the reported angles.
constexpr double kRudderPerHeading = 0.3, kRudderPerRate_s = 0.15;
constexpr double kPitchPerDepth_m = 0.15, kElevatorPerPitch = 0.4, kElevatorPerRate_s = 0.2;
constexpr double kMostPitch_rad = 8 * base::kRadiansPerDegree, kMost_rad = 6 * base::kRadiansPerDegree;

double bounded(double value, double bound) { return std::clamp(value, -bound, bound); }

/// Steers a simulated vehicle as the recorded one was steered. Servos and shaft follow the given angles and
/// speeds. A small correction of rudder and elevator keeps heading and depth near those of the record. Without
/// it, an elevator error of a tenth of a degree grows to metres of depth within ten minutes.
class TrajectoryTracker final : public sim::Helm {
 public:
  /// `servos_rad` at the times of the rows.
  TrajectoryTracker(std::span<const ActuatorTrack::Row> rows, std::vector<Vector3> servos_rad,
                    const Trajectory10Hz& course, const config::FinSettings& fins)
      : rows_(rows), servos_rad_(std::move(servos_rad)), course_(course), fins_(fins) {}

  [[nodiscard]] sim::Body start() const override {
    sim::Body body;
    body.position_m.z() = course_.depth_m.front();
    body.euler_rad = {course_.roll_rad.front(), course_.pitch_rad.front(), course_.heading_rad.front()};
    body.velocity[0] = course_.surge_m_s.front();
    return body;
  }
  [[nodiscard]] sim::ActuatorValues positions_at_start() const override {
    return sim::Controls{base::vector_of(servos_rad_.front()), rows_.front().shaft_rps}.values();
  }
  [[nodiscard]] Positions positions() const override { return Positions::written; }
  void next(double time_s, double step_s, const sim::Body& body, sim::Actuators& actuators) override {
    const Wanted wanted = wanted_at(time_s);
    const double turned = std::remainder(wanted.heading_rad - body.euler_rad[2], 2 * std::numbers::pi);
    const double rudder =
        kRudderPerHeading * turned + kRudderPerRate_s * (wanted.yaw_rate_rad_s - body.velocity[5]);
    const double pitch_wanted =
        wanted.pitch_rad - bounded(kPitchPerDepth_m * (wanted.depth_m - body.position_m.z()), kMostPitch_rad);
    const double elevator = kElevatorPerPitch * (pitch_wanted - body.euler_rad[1]) +
                            kElevatorPerRate_s * (wanted.pitch_rate_rad_s - body.velocity[4]);
    const double follows = -std::expm1(-step_s / fins_.lag_s);
    rudder_rad_ += follows * (bounded(rudder, kMost_rad) - rudder_rad_);
    elevator_rad_ += follows * (bounded(elevator, kMost_rad) - elevator_rad_);

    const auto row = static_cast<std::size_t>(std::lround((time_s + step_s) / ActuatorTrack::kStep_s));
    finished_ = row >= rows_.size();
    const double shaft_rps = rows_[std::min(row, rows_.size() - 1)].shaft_rps;
    const Vector3& servos_rad = servos_rad_[std::min(row, rows_.size() - 1)];
    Eigen::Vector3d fins_rad = autopilot::mixed_fins(rudder_rad_, elevator_rad_);
    for (Eigen::Index i = 0; i < 3; ++i) {
      fins_rad[i] = bounded(fins_rad[i] + servos_rad[static_cast<std::size_t>(i)], fins_.limit_rad);
    }
    actuators.commands = actuators.positions = sim::Controls{fins_rad, shaft_rps}.values();
  }
  [[nodiscard]] bool finished() const override { return finished_; }

 private:
  /// Recorded motion at one time, by linear interpolation between the 10 Hz rows.
  struct Wanted {
    double heading_rad = 0, yaw_rate_rad_s = 0, pitch_rad = 0, pitch_rate_rad_s = 0, depth_m = 0;
  };
  // The record is interpolated: a staircase of ten steps a second would make the fins ripple in step with the
  // card's reports. The reports would always sample the same side of the ripple. In a steady turn they would show
  // a rudder that is thirds of a per cent too small.
  [[nodiscard]] Wanted wanted_at(double time_s) const {
    const double place = std::clamp((time_s - course_.time_s.front()) / kInterval_s, 0.0,
                                    static_cast<double>(course_.time_s.size() - 1));
    const auto before = static_cast<std::size_t>(place);
    const std::size_t after = std::min(before + 1, course_.time_s.size() - 1);
    const double part = place - static_cast<double>(before);
    const auto between = [&](const std::vector<double>& of) {
      return of[before] + part * (of[after] - of[before]);
    };
    const double turn_rad =
        std::remainder(course_.heading_rad[after] - course_.heading_rad[before], 2 * std::numbers::pi);
    return {course_.heading_rad[before] + part * turn_rad, between(course_.yaw_rate_rad_s),
            between(course_.pitch_rad), between(course_.pitch_rate_rad_s), between(course_.depth_m)};
  }

  std::span<const ActuatorTrack::Row> rows_;
  std::vector<Vector3> servos_rad_;
  const Trajectory10Hz& course_;
  config::FinSettings fins_;
  double rudder_rad_ = 0, elevator_rad_ = 0;  ///< correction to the reported angles, after the servos' lag
  bool finished_ = false;
};

/// 2026-01-01; any full second would serve.
constexpr std::int64_t kSomeSecond_ns = 1'767'225'600 * base::kSecond_ns;
/// A receiver's noise is settled after so many fixes.
constexpr int kPoorFixes = 8;

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
  const sim::SimulatedMotion motion(
      vehicle, std::move(helm),
      {.start_ns = begin_ns, .influencer = &effects, .history_s = 20, .field_world_uT = field.north_east_down_uT});
  sim::Recording::Options options{begin_ns, true, seed, &effects, false, true};
  options.instruments = recorded.mission().instruments;
  Mission mission = simulated_mission(options, motion, recorded.mission().duration_s);
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
    mission.take_order_times();
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
