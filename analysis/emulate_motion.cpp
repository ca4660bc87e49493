// SPDX-License-Identifier: Apache-2.0
#include "analysis/emulate_motion.h"

#include <utility>

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

EmulatedMotion emulate_motion(const EmulateArguments& arguments, std::int64_t start_ns,
                              sim::VehicleInfluencer& influencer, std::function<std::int64_t()> now_ns) {
  const auto vehicle =
      arguments.vehicle.empty() ? config::VehicleSettings{} : config::load_vehicle(arguments.vehicle);
  if (arguments.ordered) {
    const OrderedMotion::Options options{start_ns, kHistory_s, &influencer, std::move(now_ns)};
    auto motion = std::make_unique<OrderedMotion>(vehicle, options);
    OrderedMotion* const ordered = motion.get();
    return {std::move(motion), ordered};
  }
  if (!arguments.mission.empty()) {
    auto helm = std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(arguments.mission));
    const sim::MotionOptions options{.start_ns = start_ns, .influencer = &influencer, .history_s = kHistory_s};
    return {std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options)};
  }
  auto rows = arguments.path.empty() ? sim::default_path() : sim::load_path(arguments.path);
  return {std::make_unique<sim::PathMotion>(std::move(rows), start_ns)};
}

}  // namespace navcal::analysis
