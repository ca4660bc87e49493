// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mission, as limits of one and as a vehicle: an Error, or something that holds to its rules. A
// vehicle comes back from its file, a mission from its text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "config/mission_file.h"
#include "config/mission_limits.h"
#include "config/mission_text.h"
#include "config/vehicle_file.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::mission_target {

NAVCAL_FUZZ(mission) {
  using namespace navcal::config;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  try {
    const Mission mission = parse_mission(input, "fuzz.toml");
    if (mission.steps.empty()) std::abort();
    for (const MissionStep& step : mission.steps) {
      if (step.kind == StepKind::leg && step.seconds.has_value() == step.metres.has_value()) std::abort();
      if (step.kind == StepKind::swing && !step.stations) std::abort();
      if (step.line == 0) std::abort();
    }
    if (parse_mission(mission_text(mission), "again.toml").steps.size() != mission.steps.size()) std::abort();
  } catch (const Error& error) {
    if (error.problems().empty()) std::abort();
  }
  try {
    const MissionLimits limits = parse_mission_limits(input, "fuzz.toml");
    if (!(limits.least_depth_m < limits.greatest_depth_m) || !(limits.duration_s > 0)) std::abort();
  } catch (const Error& error) {
    if (error.problems().empty()) std::abort();
  }
  try {
    const VehicleSettings vehicle = parse_vehicle(input, "fuzz.toml");
    if (!(parse_vehicle(vehicle_file(vehicle), "again.toml") == vehicle)) std::abort();
  } catch (const Error& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}

}  // namespace navcal::fuzz::mission_target
