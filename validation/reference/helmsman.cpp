// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/helmsman.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::reference {
namespace {

constexpr double kFinRange_rad = 15 * kDegree, kPitchRange_rad = 25 * kDegree;
constexpr double kMetresPerTurn = 0.0872;  ///< of the shaft, at a steady speed
/// Integrals are for small errors that stay: a turn or a dive must not wind them up.
constexpr double kNear_rad = 0.2, kNear_m = 0.4;

void gather(double& sum, double missed, double near) {
  if (std::abs(missed) < near) sum += missed * Helmsman::kPeriod_s;
}

}  // namespace

Controls Helmsman::steer(const Order& order, const Compass::Reading& compass, const Card::Reading& card) {
  double rudder = order.rudder_rad, elevator = order.elevator_rad;
  if (order.heading_rad) {
    const double missed =
        std::remainder(*order.heading_rad - compass.heading_rad - variation_rad_, 2 * std::numbers::pi);
    gather(heading_sum_, missed, kNear_rad);
    rudder =
        std::clamp(0.35 * missed + 0.02 * heading_sum_ - 0.3 * card.yaw_rate_rad_s, -kFinRange_rad, kFinRange_rad);
  }
  if (order.depth_m) {
    const double missed = *order.depth_m - card.depth_m;
    gather(depth_sum_, missed, kNear_m);
    const double pitch = std::clamp(-(0.3 * missed + 0.02 * depth_sum_), -kPitchRange_rad, kPitchRange_rad);
    elevator =
        std::clamp(0.8 * (pitch - compass.pitch_rad) - 0.4 * card.pitch_rate_rad_s, -kFinRange_rad, kFinRange_rad);
  }
  const double shaft_rev_s = order.speed_m_s ? *order.speed_m_s / kMetresPerTurn : order.shaft_rev_s;
  return {shaft_rev_s, FinLinkage::mixed(rudder, elevator) + order.fins_beside_rad};
}

}  // namespace navcal::reference
