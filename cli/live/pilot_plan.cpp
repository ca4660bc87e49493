// SPDX-License-Identifier: Apache-2.0
#include "cli/live/pilot_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/failure.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::cli {
namespace {

[[noreturn]] void refuse_plan(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

}  // namespace

PilotPlan plan_mission(const config::VehicleSettings& vehicle, const config::Mission& mission,
                       const autopilot::PilotLimits& limits) {
  constexpr double kStep_s = 0.1;
  auto helm = std::make_unique<sim::MissionHelm>(vehicle, mission);
  const sim::MissionHelm& under_way = *helm;
  PilotPlan plan;
  try {
    const sim::SimulatedMotion motion(vehicle, std::move(helm), {.history_s = 1});
    while (!under_way.finished()) {
      plan.duration_s += kStep_s;
      const auto position_m = motion.at(std::llround(plan.duration_s * 1e9)).position_m;
      plan.deepest_m = std::max(plan.deepest_m, position_m[2]);
      plan.farthest_m = std::max(plan.farthest_m, std::hypot(position_m[0], position_m[1]));
      if (plan.duration_s > limits.duration_s) {
        refuse_plan(
            fmt::format("the mission takes more than {:g} minutes (--max-minutes)", limits.duration_s / 60));
      }
    }
  } catch (const sim::UnstableVehicle& error) {
    refuse_plan(std::string("the gains make the simulated vehicle unstable: ") + error.what());
  }
  if (plan.deepest_m > limits.depth_m) {
    refuse_plan(fmt::format("the mission goes to {:.1f} m, deeper than {:g} m (--max-depth)", plan.deepest_m,
                            limits.depth_m));
  }
  if (plan.farthest_m > limits.range_m) {
    refuse_plan(fmt::format("the mission goes {:.0f} m away, farther than {:g} m (--max-range)", plan.farthest_m,
                            limits.range_m));
  }
  return plan;
}

}  // namespace navcal::cli
