// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "config/mission.h"
#include "config/mission_limits.h"
#include "config/vehicle.h"

namespace navcal::gap {

/// A manoeuvre of the alphabet from which missions are composed. It begins on a leg at the cruising speed and the
/// working depth, and ends so.
struct Segment {
  std::string_view name;  ///< "rudder doublets, small"
  std::vector<config::MissionStep> steps;
};

/// Speeds and depths that the manoeuvres use, within the limits with a margin for overshoot.
struct Regime {
  bool by_shaft = true;  ///< speeds are those of the shaft, 1/s; else m/s
  double slow = 0, cruise = 0, fast = 0;
  double working_m = 0, deep_m = 0;  ///< depths
  double gentle_rad_s = 0, brisk_rad_s = 0;
  bool surfaces = false;  ///< steps to the surface are within the limits
};
[[nodiscard]] Regime regime_of(const config::VehicleSettings& vehicle, const config::MissionLimits& limits);
/// The same for missions with speeds through the water. `greatest_m_s`: the speed that the vehicle can keep.
[[nodiscard]] Regime regime_of(double greatest_m_s, const config::MissionLimits& limits);

/// All manoeuvres. Whether each stays within the limits shows when it is simulated.
[[nodiscard]] std::vector<Segment> alphabet(const Regime& regime);

/// A manoeuvre of a plan, and the heading at which it begins.
struct PlacedSegment {
  std::size_t segment = 0;  ///< index into the alphabet
  double heading_rad = 0;
};
/// Mission of an opening with fixes, these manoeuvres and an ending with fixes. `first_step`: index of the first
/// step of each manoeuvre, and that of the ending.
struct ComposedMission {
  config::Mission mission;
  std::vector<std::size_t> first_step;
};
[[nodiscard]] ComposedMission compose(const std::vector<PlacedSegment>& placed,
                                      const std::vector<Segment>& alphabet, const Regime& regime);

}  // namespace navcal::gap
