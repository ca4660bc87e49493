// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planned_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/angles.h"
#include "base/durations.h"
#include "gap/actuators/commanded_motor.h"
#include "gap/data/innovations.h"
#include "gap/data/simulated_mission.h"
#include "sim/vehicle/mission_helm.h"

namespace navcal::gap {
namespace {

/// 2026-01-01; any full second would serve.
constexpr std::int64_t kPlanBegin_ns = 1'767'225'600 * base::kSecond_ns;
/// Up or down, whatever the limits: beyond it a vehicle is near standing on end.
constexpr double kSteepest_deg = 45;
/// Depth above which a step to the surface keeps the vehicle, m.
constexpr double kAwash_m = 0.02;

double turn_of(const sim::State& state) {
  return (std::sin(state.euler_rad[0]) * state.rate_rad_s[1] +
          std::cos(state.euler_rad[0]) * state.rate_rad_s[2]) /
         std::max(0.1, std::cos(state.euler_rad[1]));
}

void append(const sim::State& state, double time_s, PlannedPath& path) {
  path.time_s.push_back(time_s);
  path.north_m.push_back(state.position_m[0]);
  path.east_m.push_back(state.position_m[1]);
  path.depth_m.push_back(state.position_m[2]);
  path.roll_rad.push_back(state.euler_rad[0]);
  path.pitch_rad.push_back(state.euler_rad[1]);
  path.heading_rad.push_back(state.euler_rad[2]);
  path.turn_rad_s.push_back(turn_of(state));
  const auto& v = state.velocity_body_m_s;
  path.speed_m_s.push_back(std::hypot(v[0], v[1], v[2]));
  path.shaft_rps.push_back(state.rpm / 60);
  path.current_A.push_back(state.motor_current_A);
}

}  // namespace

config::Mission once(config::Mission mission) {
  mission.at_end = config::MissionEnd::hold;
  return mission;
}

PlannedPath planned_path(const config::VehicleSettings& vehicle, const config::Mission& mission,
                         const sim::EffectSet& effects, double longest_s) {
  sim::EffectSet own = effects;
  auto helm = std::make_unique<sim::MissionHelm>(vehicle, once(mission));
  const sim::MissionHelm& under_way = *helm;
  const sim::SimulatedMotion motion(vehicle, std::move(helm), sim::MotionOptions{0, &own, 20});
  PlannedPath path = path_of(
      motion, [&] { return under_way.finished(); }, longest_s);
  path.step_began_s = under_way.step_began_s();
  return path;
}

PlannedPath path_of(const sim::SimulatedMotion& motion, const std::function<bool()>& is_finished,
                    double longest_s) {
  PlannedPath path;
  for (int i = 0;; ++i) {
    const double time_s = i * kInterval_s;
    const sim::State state = motion.at(std::llround(time_s * 1e9));
    if (is_finished() || time_s > longest_s) break;
    append(state, time_s, path);
    path.duration_s = time_s + kInterval_s;
  }
  return path;
}

PathExtremes extremes_of(const PlannedPath& path, const config::MissionLimits& limits, double from_s,
                         double until_s) {
  PathExtremes extremes;
  extremes.least_depth_m = 1e9;
  if (path.has_card) extremes.shaft_rps = extremes.energy_Wh = 0;
  for (std::size_t i = 0; i < path.time_s.size(); ++i) {
    if (path.time_s[i] < from_s || path.time_s[i] >= until_s) continue;
    extremes.duration_s += kInterval_s;
    extremes.least_depth_m = std::min(extremes.least_depth_m, path.depth_m[i]);
    extremes.greatest_depth_m = std::max(extremes.greatest_depth_m, path.depth_m[i]);
    extremes.range_m = std::max(extremes.range_m, std::hypot(path.north_m[i], path.east_m[i]));
    extremes.speed_m_s = std::max(extremes.speed_m_s, path.speed_m_s[i]);
    extremes.turn_rad_s = std::max(extremes.turn_rad_s, std::abs(path.turn_rad_s[i]));
    extremes.pitch_rad = std::max(extremes.pitch_rad, std::abs(path.pitch_rad[i]));
    if (!path.has_card) continue;
    extremes.shaft_rps = std::max(*extremes.shaft_rps, path.shaft_rps[i]);
    *extremes.energy_Wh += limits.supply_V * (path.current_A[i] + limits.hotel_A) * kInterval_s / 3600;
  }
  return extremes;
}

std::vector<std::string> violations(const PathExtremes& extremes, const config::MissionLimits& limits) {
  std::vector<std::string> all;
  const auto most = [&](std::string_view what, std::optional<double> value, double limit, std::string_view unit) {
    if (value && *value > limit)
      all.push_back(fmt::format("{} {:.3g} {}, at most {:.3g} {}", what, *value, unit, limit, unit));
  };
  most("duration", extremes.duration_s / 60, limits.duration_s / 60, "min");
  most("depth", extremes.greatest_depth_m, limits.greatest_depth_m, "m");
  most("distance", extremes.range_m, limits.range_m, "m");
  most("speed", extremes.speed_m_s, limits.speed_m_s, "m/s");
  most("shaft speed", extremes.shaft_rps ? std::optional(*extremes.shaft_rps * 60) : std::nullopt,
       limits.shaft_rps * 60, "rpm");
  most("rate of turn", extremes.turn_rad_s * base::kDegreesPerRadian, limits.turn_rad_s * base::kDegreesPerRadian,
       "deg/s");
  most("pitch", extremes.pitch_rad * base::kDegreesPerRadian, kSteepest_deg, "deg");
  most("energy", extremes.energy_Wh, limits.energy_Wh, "Wh");
  if (extremes.least_depth_m < limits.least_depth_m && limits.least_depth_m > 0.2) {
    all.push_back(fmt::format("depth {:.3g} m, at least {:.3g} m", extremes.least_depth_m, limits.least_depth_m));
  }
  if (extremes.least_depth_m < kAwash_m) all.emplace_back("the vehicle leaves the water");
  return all;
}

Mission planned_readings(const config::VehicleSettings& vehicle, const config::Mission& mission,
                         const PlannedInstruments& with, double duration_s) {
  auto helm = std::make_unique<sim::MissionHelm>(vehicle, once(mission));
  const sim::SimulatedMotion motion(
      vehicle, std::move(helm),
      {.start_ns = kPlanBegin_ns, .history_s = 20, .field_world_uT = with.field.north_east_down_uT});
  sim::Recording::Options options{kPlanBegin_ns, false, 1, nullptr, false, false};
  options.instruments = with.instruments;
  Mission readings = simulated_mission(options, motion, duration_s);
  readings.field = with.field;
  obey_orders(readings, vehicle);
  return readings;
}

}  // namespace navcal::gap
