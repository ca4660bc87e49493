// SPDX-License-Identifier: Apache-2.0
#include "gap/design/alphabet.h"

#include <algorithm>
#include <numbers>

#include "autopilot/shaft_speed.h"
#include "config/mission_file.h"
#include "config/mission_text.h"

namespace navcal::gap {
namespace {

using config::MissionStep;
using config::StepKind;
using config::Surface;

constexpr double kRad_per_degree = std::numbers::pi / 180;

MissionStep leg(double seconds) { return {.kind = StepKind::leg, .seconds = seconds}; }
MissionStep dive(double depth_m) { return {.kind = StepKind::dive, .depth_m = depth_m, .seconds = 40}; }
MissionStep surface(double seconds) { return {.kind = StepKind::surface, .seconds = seconds}; }
/// A shaft that stands is the slowest speed of both kinds.
MissionStep speed(const Regime& r, double value, double seconds) {
  MissionStep step{.kind = StepKind::speed, .seconds = seconds};
  (r.by_shaft || value == 0 ? step.shaft_rps : step.speed_m_s) = value;
  return step;
}
MissionStep circle(double turns, double rate_rad_s) {
  return {.kind = StepKind::circle, .turns = turns, .rate_rad_s = rate_rad_s};
}
MissionStep spiral(double turns, double rate_rad_s, double depth_m) {
  return {.kind = StepKind::spiral, .turns = turns, .rate_rad_s = rate_rad_s, .depth_m = depth_m};
}
MissionStep doublet(Surface on, double amplitude_deg, double seconds, int times) {
  return {.kind = StepKind::doublet,
          .seconds = seconds,
          .amplitude_rad = amplitude_deg * kRad_per_degree,
          .times = times,
          .on = on};
}
MissionStep zigzag(double rudder_deg, double reach_deg, int times) {
  return {.kind = StepKind::zigzag,
          .rudder_rad = rudder_deg * kRad_per_degree,
          .reach_rad = reach_deg * kRad_per_degree,
          .times = times};
}

void add_turns(const Regime& r, std::vector<Segment>& all) {
  all.push_back({"circle to starboard, gentle", {circle(1, r.gentle_rad_s)}});
  all.push_back({"circle to port, gentle", {circle(-1, r.gentle_rad_s)}});
  all.push_back({"two circles to starboard, brisk", {circle(2, r.brisk_rad_s)}});
  all.push_back({"two circles to port, brisk", {circle(-2, r.brisk_rad_s)}});
  all.push_back(
      {"circles both ways, slow",
       {speed(r, r.slow, 4), circle(1, r.gentle_rad_s), circle(-1, r.gentle_rad_s), speed(r, r.cruise, 4)}});
  all.push_back(
      {"circles both ways, fast",
       {speed(r, r.fast, 4), circle(1, r.brisk_rad_s), circle(-1, r.brisk_rad_s), speed(r, r.cruise, 4)}});
  all.push_back(
      {"spirals down and up", {spiral(1, r.brisk_rad_s, r.deep_m), spiral(-1, r.brisk_rad_s, r.working_m)}});
  all.push_back({"zigzag, gentle", {zigzag(6, 10, 6)}});
  all.push_back({"zigzag, hard", {zigzag(15, 20, 6)}});
}

void add_doublets(const Regime& r, std::vector<Segment>& all) {
  all.push_back({"rudder doublets, small", {doublet(Surface::rudder, 2, 1, 6), leg(2)}});
  all.push_back({"rudder doublets, medium", {doublet(Surface::rudder, 7, 1.5, 4), leg(2)}});
  all.push_back({"rudder doublets, large", {doublet(Surface::rudder, 15, 2, 2), leg(3)}});
  all.push_back(
      {"rudder doublets, slow", {speed(r, r.slow, 5), doublet(Surface::rudder, 12, 2, 3), speed(r, r.cruise, 4)}});
  all.push_back(
      {"rudder doublets, fast", {speed(r, r.fast, 5), doublet(Surface::rudder, 6, 1, 4), speed(r, r.cruise, 4)}});
  all.push_back({"elevator doublets, small", {doublet(Surface::elevator, 2, 0.8, 4), leg(3)}});
  all.push_back({"elevator doublets, large", {doublet(Surface::elevator, 5, 1.5, 2), leg(4)}});
  all.push_back({"doublets of each fin",
                 {doublet(Surface::fin1, 4, 0.8, 3), leg(3), doublet(Surface::fin2, 4, 0.8, 3), leg(3),
                  doublet(Surface::fin3, 4, 0.8, 3), leg(3)}});
}

void add_speeds_and_depths(const Regime& r, std::vector<Segment>& all) {
  all.push_back({"leg", {leg(12)}});
  all.push_back({"speed steps", {speed(r, r.slow, 8), speed(r, r.fast, 8), speed(r, r.cruise, 5)}});
  all.push_back({"speed steps, quick",
                 {speed(r, r.slow, 3), speed(r, r.fast, 3), speed(r, r.slow, 3), speed(r, r.fast, 3),
                  speed(r, r.cruise, 3)}});
  all.push_back({"coasting", {speed(r, 0, 12), speed(r, r.cruise, 6)}});
  all.push_back({"dive and climb", {dive(r.deep_m), leg(5), dive(r.working_m)}});
  all.push_back({"dives, repeated", {dive(r.deep_m), dive(r.working_m), dive(r.deep_m), dive(r.working_m)}});
  if (!r.surfaces) return;
  MissionStep about{.kind = StepKind::turn, .by_rad = std::numbers::pi, .rate_rad_s = r.gentle_rad_s};
  MissionStep quarter{.kind = StepKind::turn, .by_rad = std::numbers::pi / 2, .rate_rad_s = r.gentle_rad_s};
  all.push_back({"surface legs there and back", {surface(12), about, surface(12), dive(r.working_m)}});
  all.push_back({"surface legs on three headings",
                 {surface(10), quarter, surface(10), quarter, surface(10), dive(r.working_m)}});
  all.push_back(
      {"drifting at the surface", {surface(4), speed(r, 0, 20), speed(r, r.cruise, 5), dive(r.working_m)}});
}

constexpr double kNearLimit = 0.93;

void set_speeds(double fast, Regime& r) {
  r.fast = fast;
  r.cruise = 0.78 * fast;
  r.slow = 0.55 * fast;
}

}  // namespace

Regime regime_of(const config::VehicleSettings& vehicle, const config::MissionLimits& limits) {
  Regime r = regime_of(0, limits);
  const double rps = autopilot::shaft_for(vehicle.propeller, vehicle.water.density_kg_m3,
                                          kNearLimit * limits.speed_m_s, autopilot::axial_drag_kg_m(vehicle));
  r.by_shaft = true;
  set_speeds(std::min({rps, 0.98 * limits.shaft_rps, vehicle.autopilot.shaft_limit_rps}), r);
  return r;
}

Regime regime_of(double greatest_m_s, const config::MissionLimits& limits) {
  Regime r{.by_shaft = false};
  set_speeds(std::min(greatest_m_s, kNearLimit * limits.speed_m_s), r);
  // The slowest that a mission can state.
  for (double* speed_m_s : {&r.slow, &r.cruise, &r.fast}) *speed_m_s = std::max(*speed_m_s, 0.05);
  r.surfaces = limits.least_depth_m <= 0.2;
  const double span_m = limits.greatest_depth_m - limits.least_depth_m;
  // A dive overshoots by some decimetres.
  const double margin_m = std::min(0.5, 0.25 * span_m);
  r.deep_m = std::min(limits.greatest_depth_m - margin_m, limits.least_depth_m + 8);
  r.working_m = std::min(limits.least_depth_m + std::max(margin_m, 0.35), 0.5 * (r.deep_m + limits.least_depth_m));
  r.gentle_rad_s = 0.35 * limits.turn_rad_s;
  r.brisk_rad_s = 0.7 * limits.turn_rad_s;
  return r;
}

std::vector<Segment> alphabet(const Regime& regime) {
  std::vector<Segment> all;
  add_turns(regime, all);
  add_doublets(regime, all);
  add_speeds_and_depths(regime, all);
  return all;
}

ComposedMission compose(const std::vector<PlacedSegment>& placed, const std::vector<Segment>& alphabet,
                        const Regime& regime) {
  ComposedMission composed;
  config::Mission& mission = composed.mission;
  mission.at_end = config::MissionEnd::hold;
  mission.start.depth_m = regime.surfaces ? 0.2 : regime.working_m;
  if (regime.by_shaft) mission.start.shaft_rps = regime.cruise;
  auto& steps = mission.steps;
  // A circle keeps a vehicle that needs way at its place while the receiver settles.
  const auto fixes = [&] {
    steps.push_back(surface(3));
    if (regime.by_shaft) steps.push_back(circle(1, regime.gentle_rad_s));
  };
  if (regime.surfaces) fixes();
  steps.push_back(dive(regime.working_m));
  steps.push_back(leg(4));
  if (!regime.by_shaft) steps.front().speed_m_s = regime.cruise;
  for (const PlacedSegment& each : placed) {
    composed.first_step.push_back(steps.size());
    steps.push_back({.kind = StepKind::turn, .heading_rad = each.heading_rad, .rate_rad_s = regime.gentle_rad_s});
    const auto& own = alphabet.at(each.segment).steps;
    steps.insert(steps.end(), own.begin(), own.end());
  }
  composed.first_step.push_back(steps.size());
  if (regime.surfaces) {
    fixes();
  } else {
    steps.push_back(leg(5));
  }
  // The numbers of the file, so that what is simulated is what is written.
  mission = config::parse_mission(config::mission_text(mission), "the mission planned");
  return composed;
}

}  // namespace navcal::gap
