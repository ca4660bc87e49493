// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/angles.h"
#include "sim/layout/assessment/parts.h"

namespace navcal::sim::assessment {
namespace {

void check_stability(const Statics& statics, std::vector<Oddity>& odd) {
  if (!(statics.metacentric_height_m > 0))
    odd.push_back(
        {"body.gravity_centre_m",
         fmt::format("unstable in roll and pitch: the centre of gravity is {:.4g} m above that of buoyancy",
                     0 - statics.metacentric_height_m)});
  constexpr double kMuch_rad = 20 * base::kRadiansPerDegree;
  if (statics.metacentric_height_m > 0 &&
      (std::abs(statics.roll_rad) > kMuch_rad || std::abs(statics.pitch_rad) > kMuch_rad))
    odd.push_back(
        {"body.gravity_centre_m",
         fmt::format("at rest it lies with roll {:.1f} and pitch {:.1f} degrees",
                     statics.roll_rad * base::kDegreesPerRadian, statics.pitch_rad * base::kDegreesPerRadian)});
}

/// Power that hull and surfaces take at a small motion along each degree of freedom.
void check_damping(const LayoutVehicle& vehicle, std::vector<Oddity>& odd) {
  LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(vehicle.layout()));
  held.restoring = {0, Eigen::Vector3d::Zero()};
  for (Eigen::Index i = 0; i < 6; ++i) {
    Vector6 velocity = Vector6::Zero();
    velocity[i] = 0.5;
    const double power = vehicle.force(velocity, Eigen::Vector3d::UnitZ(), held).dot(velocity);
    const char* const name = autopilot::kDegreesOfFreedom[static_cast<std::size_t>(i)];
    if (power > 1e-12) {
      odd.push_back(
          {"damping", fmt::format("{} at 0.5 {} is driven with {:.3g} W: the file wants damping positive", name,
                                  i < 3 ? "m/s" : "rad/s", power)});
    } else if (power > -1e-12) {
      odd.push_back({"damping", fmt::format("nothing brakes {}", name)});
    }
  }
}

void check_thrust(const config::Layout& layout, const Assessment& found, std::vector<Oddity>& odd) {
  for (const SteadySpeed& steady : found.ahead) {
    if (!steady.speed_m_s)
      odd.push_back({"damping", fmt::format("at {} no terminal speed below 30 m/s is reached with {:.4g} N",
                                            steady.what, steady.force_N)});
  }
  if (found.ahead.empty()) return;
  const double force_N = std::abs(found.ahead.back().force_N);
  if (force_N > 10 * layout.weight_N())
    odd.push_back(
        {"thruster",
         fmt::format("full thrust ahead of {:.4g} N is {:.0f} times the weight: a unit off by a thousand?",
                     force_N, force_N / layout.weight_N())});
  const double speed = found.ahead.back().speed_m_s.value_or(0);
  if (speed > 10)
    odd.push_back({"thruster",
                   fmt::format("terminal speed ahead is {:.3g} m/s: thrust too large or drag too small", speed)});
}

void check_motions(const std::vector<SteadyMotion>& motions, std::vector<Oddity>& odd) {
  constexpr double kSpin_rad_s = 20 * base::kRadiansPerDegree, kStray_rad_s = 1 * base::kRadiansPerDegree;
  constexpr double kTilt_rad = 10 * base::kRadiansPerDegree;
  for (const SteadyMotion& motion : motions) {
    const bool is_straight = motion.what.starts_with("straight");
    if (!motion.failure.empty()) {
      odd.push_back({"", fmt::format("{}: {}{}", motion.what, motion.failure,
                                     is_straight ? "; it needs an autopilot at all times" : "")});
      continue;
    }
    if (!motion.is_steady)
      odd.push_back({"", fmt::format("{}: not steady after the longest time simulated", motion.what)});
    if (!is_straight) continue;
    const double spin = std::max(std::abs(motion.roll_rate_rad_s), std::abs(motion.turn_rad_s));
    const double tilt = std::max(std::abs(motion.roll_rad), std::abs(motion.pitch_rad));
    if (spin < kStray_rad_s && tilt < kTilt_rad) continue;
    odd.push_back(
        {spin > kSpin_rad_s ? "thruster" : "",
         fmt::format("{}: {}: roll {:.1f}, pitch {:.1f} deg, rolls with {:.1f}, turns with {:.1f} deg/s",
                     motion.what, spin > kSpin_rad_s ? "it spins" : "it does not keep straight",
                     motion.roll_rad * base::kDegreesPerRadian, motion.pitch_rad * base::kDegreesPerRadian,
                     motion.roll_rate_rad_s * base::kDegreesPerRadian,
                     motion.turn_rad_s * base::kDegreesPerRadian)});
  }
}

void check_allocation(const config::Layout& layout, const Assessment& found, std::vector<Oddity>& odd) {
  const auto actuators = layout.thrusters.size() + layout.surfaces.size();
  if (actuators == 0) {
    if (layout.ballasts.empty()) odd.push_back({"thruster", "there are no actuators: it can only drift"});
    return;
  }
  const auto& under_way = found.under_way;
  constexpr double kIll = 1e3;
  if (under_way.rank == 0) {
    odd.push_back({"thruster", "the allocation matrix is zero: no actuator gives any force"});
  } else if (under_way.condition > kIll) {
    odd.push_back(
        {"thruster", fmt::format("the allocation matrix is nearly singular: condition {:.3g} over its rank of {}",
                                 under_way.condition, under_way.rank)});
  }
  if (under_way.rank > 0 && static_cast<std::size_t>(under_way.rank) < std::min<std::size_t>(actuators, 6))
    odd.push_back({"thruster", fmt::format("the allocation matrix is singular: {} actuators, rank {}; {}",
                                           actuators, under_way.rank, fmt::join(under_way.missing, "; "))});
}

}  // namespace

std::vector<Oddity> oddities_of_motion(const LayoutVehicle& vehicle, const Assessment& found) {
  std::vector<Oddity> odd;
  check_stability(found.statics, odd);
  check_damping(vehicle, odd);
  check_thrust(vehicle.layout(), found, odd);
  check_motions(found.motions, odd);
  check_allocation(vehicle.layout(), found, odd);
  return odd;
}

}  // namespace navcal::sim::assessment
