// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "config/mission_limits.h"
#include "gap/data/innovations.h"
#include "gap/design/planned_mission.h"

namespace navcal::gap {

/// The regimes that a mission sails, as words: "turns of 12 to 25 deg/s to port", "0.8 to 1.6 m deep". A regime
/// counts from five seconds on. Depths are in thirds of the limits.
[[nodiscard]] std::set<std::string> regimes_sailed(const Trajectory10Hz& course,
                                                   const config::MissionLimits& limits);
[[nodiscard]] std::set<std::string> regimes_sailed(const std::vector<PlannedInstant>& track,
                                                   const config::MissionLimits& limits);

}  // namespace navcal::gap
