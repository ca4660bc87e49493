// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/pilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace navcal::reference::thrusters
