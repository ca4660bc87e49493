// SPDX-License-Identifier: Apache-2.0
#include "analysis/emulate_motion.h"

#include "config/mission_file.h"
#include "config/vehicle_file.h"
#include "sim/default_path.h"
#include "sim/path.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::analysis {
namespace {

/// Instruments look back by their latencies, and by as long as this process was stopped.
constexpr double kHistory_s = 600;

}  // namespace

std::unique_ptr<sim::Motion> emulate_motion(const EmulateArguments& arguments, std::int64_t start_ns) {
  if (!arguments.mission.empty()) {
    const auto vehicle =
        arguments.vehicle.empty() ? config::VehicleSettings{} : config::load_vehicle(arguments.vehicle);
    auto helm = std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(arguments.mission));
    return std::make_unique<sim::SimulatedMotion>(
        vehicle, std::move(helm), sim::MotionOptions{.start_ns = start_ns, .history_s = kHistory_s});
  }
  auto rows = arguments.path.empty() ? sim::default_path() : sim::load_path(arguments.path);
  return std::make_unique<sim::PathMotion>(std::move(rows), start_ns);
}

}  // namespace navcal::analysis
