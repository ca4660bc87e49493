// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "autopilot/pilot.h"
#include "config/mission.h"
#include "config/vehicle.h"

namespace navcal::cli {

/// Duration, depth and range of a mission in still water, by simulation of the vehicle with its autopilot.
struct PilotPlan {
  double duration_s = 0;
  double deepest_m = 0;
  double farthest_m = 0;  ///< from the beginning
};

/// Throws Failure when the mission goes beyond a limit, or the simulated vehicle goes unstable.
[[nodiscard]] PilotPlan plan_mission(const config::VehicleSettings& vehicle, const config::Mission& mission,
                                     const autopilot::PilotLimits& limits);

}  // namespace navcal::cli
