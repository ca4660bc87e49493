// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "autopilot/allocation.h"
#include "sim/layout/assessment/parts.h"

namespace navcal::sim::assessment {
namespace {

/// Where a run stands now; rates are means over the second that it takes for this.
void describe(LayoutRun& run, const ActuatorValues& commands, SteadyMotion& motion) {
  const Body before = run.body();
  run.advance(commands, 1);
  const Body& body = run.body();
  const Vector6& nu = body.velocity;
  motion.speed_m_s = nu.head<3>().norm();
  motion.surge_m_s = nu[0];
  motion.roll_rad = body.euler_rad[0];
  motion.pitch_rad = body.euler_rad[1];
  motion.roll_rate_rad_s = body.euler_rad[0] - before.euler_rad[0];
  motion.turn_rad_s = body.euler_rad[2] - before.euler_rad[2];
  const double sunk_m = body.position_m.z() - before.position_m.z();
  motion.path_rad = motion.speed_m_s > 0 ? -std::asin(std::clamp(sunk_m / motion.speed_m_s, -1.0, 1.0)) : 0;
  motion.attack_rad = std::atan2(nu[2], nu[0]);
  constexpr double kHardlyTurns_rad_s = 1e-3;
  motion.radius_m.reset();
  if (std::abs(motion.turn_rad_s) > kHardlyTurns_rad_s)
    motion.radius_m = motion.speed_m_s / std::abs(motion.turn_rad_s);
}

/// Runs until speeds, rates and attitude no longer change, or to the end of the time.
SteadyMotion run_to_rest(std::string what, const LayoutVehicle& vehicle, const Body& start,
                         const ActuatorValues& positions, const ActuatorValues& commands, double longest_s) {
  SteadyMotion motion;
  motion.what = std::move(what);
  constexpr double kSlice_s = 10, kSame = 1e-3;
  try {
    LayoutRun run(vehicle, start, positions);
    Vector6 before = start.velocity;
    while (run.time_s() < longest_s && !motion.is_steady) {
      run.advance(commands, kSlice_s);
      describe(run, commands, motion);
      motion.is_steady =
          (run.body().velocity - before).cwiseAbs().maxCoeff() < kSame * (0.1 + before.cwiseAbs().maxCoeff());
      before = run.body().velocity;
    }
  } catch (const UnstableVehicle& error) {
    motion.failure = error.what();
  }
  return motion;
}

/// A pure turn to starboard by the surfaces, or by the thrusters at rest: the largest yaw moment without roll and
/// pitch, else the largest with as little of them as may be.
std::optional<ActuatorValues> full_turn(const LayoutVehicle& vehicle, bool by_surfaces, double speed_m_s) {
  autopilot::Allocator allocator(vehicle.layout());
  for (const auto& thruster : vehicle.layout().thrusters) allocator.set_dead(thruster.name, by_surfaces);
  for (const auto& surface : vehicle.layout().surfaces) allocator.set_dead(surface.name, !by_surfaces);
  autopilot::AllocationRequest request;
  request.velocity[0] = by_surfaces ? speed_m_s : 0;
  if (by_surfaces) request.weights << 0, 0, 0, 1, 1, 1;
  const auto limits = allocator.limits(request.velocity);
  const Eigen::VectorXd most = limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
  const double attainable_Nm = allocator.matrix(request.velocity).row(5).cwiseAbs() * most;
  if (!(attainable_Nm > 0)) return std::nullopt;
  request.wanted[5] = attainable_Nm;
  autopilot::Allocation allocation = allocator.allocate(request);
  constexpr double kHardly = 0.02;
  if (allocation.part < kHardly) {
    request.saturation = autopilot::Saturation::least_squares;
    request.weights << 0, 0, 0, 0.1, 0.1, 1;
    allocation = allocator.allocate(request);
  }
  if (std::abs(allocation.reached[5]) < kHardly * attainable_Nm) return std::nullopt;
  ActuatorValues values = by_surfaces ? ahead_at(vehicle.layout(), 1) : ActuatorValues::neutral(vehicle.layout());
  if (by_surfaces) {
    values.surfaces_rad = allocation.surfaces_rad;
  } else {
    values.thrusters = allocation.thruster_commands;
  }
  return values;
}

/// The largest pure force ahead; where thrusters cannot give one, all of them full ahead.
ActuatorValues straight_ahead(const LayoutVehicle& vehicle, double speed_m_s) {
  autopilot::Allocator allocator(vehicle.layout());
  for (const auto& surface : vehicle.layout().surfaces) allocator.set_dead(surface.name);
  autopilot::AllocationRequest request;
  request.velocity[0] = speed_m_s;
  const auto limits = allocator.limits(request.velocity);
  request.wanted[0] = allocator.matrix(request.velocity).row(0).cwiseAbs() * limits.high;
  const autopilot::Allocation allocation = allocator.allocate(request);
  ActuatorValues values = ahead_at(vehicle.layout(), 1);
  constexpr double kWorthwhile = 0.1;
  if (allocation.part > kWorthwhile) values.thrusters = allocation.thruster_commands;
  return values;
}

std::vector<SteadyMotion> glides_of(const LayoutVehicle& vehicle) {
  const config::Layout& layout = vehicle.layout();
  std::vector<SteadyMotion> glides;
  if (layout.ballasts.empty() || layout.moving_masses.empty() || !layout.damping.flow_axes) return glides;
  // Moved forwards for the dive and backwards for the climb.
  const double forwards = layout.moving_masses[0].axis[0] >= 0 ? 1 : -1;
  for (const double part : {0.25, 0.5, -0.25, -0.5}) {
    ActuatorValues values = ActuatorValues::neutral(layout);
    const config::LayoutBallast& ballast = layout.ballasts[0];
    const config::LayoutMovingMass& mass = layout.moving_masses[0];
    values.ballasts_N[0] = std::abs(part) * (part > 0 ? ballast.low_N : ballast.high_N);
    values.masses_m[0] = std::abs(part) * (part * forwards > 0 ? mass.high_m : mass.low_m);
    Body start;
    start.velocity[0] = 0.2;
    glides.push_back(run_to_rest(fmt::format("glide {}, {} at {:.3g} N, {} at {:.3g} m", part > 0 ? "down" : "up",
                                             ballast.name, values.ballasts_N[0], mass.name, values.masses_m[0]),
                                 vehicle, start, values, values, 300));
  }
  return glides;
}

}  // namespace

std::vector<SteadyMotion> motions_of(const LayoutVehicle& vehicle, double speed_ahead_m_s) {
  constexpr double kLongest_s = 120;
  std::vector<SteadyMotion> motions;
  const ActuatorValues neutral = ActuatorValues::neutral(vehicle.layout());
  Body under_way;
  under_way.velocity[0] = speed_ahead_m_s;
  if (speed_ahead_m_s > 0) {
    const ActuatorValues ahead = ahead_at(vehicle.layout(), 1);
    const ActuatorValues straight = straight_ahead(vehicle, speed_ahead_m_s);
    motions.push_back(
        run_to_rest("straight ahead, constant commands", vehicle, under_way, straight, straight, kLongest_s));
    if (const auto turn = full_turn(vehicle, true, speed_ahead_m_s))
      motions.push_back(run_to_rest("full rudder, full ahead", vehicle, under_way, ahead, *turn, kLongest_s));
  }
  if (const auto turn = full_turn(vehicle, false, 0))
    motions.push_back(run_to_rest("turn on the spot by thrusters", vehicle, {}, neutral, *turn, kLongest_s));
  for (SteadyMotion& glide : glides_of(vehicle)) motions.push_back(std::move(glide));
  return motions;
}

}  // namespace navcal::sim::assessment
