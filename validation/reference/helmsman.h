// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validation/reference/card.h"
#include "validation/reference/compass.h"
#include "validation/reference/mission.h"

namespace navcal::reference {

/// Commands of the helmsman.
struct Controls {
  double shaft_rev_s = 0;
  Vector3 fins_rad = Vector3::Zero();
};

/// The vehicle's own autopilot, ten times a second. It knows nothing but what the instruments say, as a vehicle's
/// does, so that their errors steer it:
///     rudder = 0.35 e + 0.02 int(e) - 0.3 r                     e: heading wanted less heading
///     pitch wanted = -(0.3 d + 0.02 int(d)), within 25 degrees    d: depth wanted less depth
///     elevator = 0.8 (pitch wanted - pitch) - 0.4 q             both within 15 degrees
class Helmsman {
 public:
  /// `variation_rad`: of magnetic north from true north where it steers, as its charts have it.
  explicit Helmsman(double variation_rad) : variation_rad_(variation_rad) {}

  static constexpr double kPeriod_s = 0.1;

  [[nodiscard]] Controls steer(const Order& order, const Compass::Reading& compass, const Card::Reading& card);

 private:
  double variation_rad_;
  double heading_sum_ = 0, depth_sum_ = 0;  ///< integrals of what was missed
};

}  // namespace navcal::reference
