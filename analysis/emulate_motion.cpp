// SPDX-License-Identifier: Apache-2.0
#include "analysis/emulate_motion.h"

#include <utility>

#include "analysis/chosen_vehicle.h"
#include "config/mission_file.h"
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
  const ChosenVehicle chosen = load_chosen_vehicle(arguments.vehicle);
  if (const auto* layout = std::get_if<config::Layout>(&chosen)) {
    const sim::MotionOptions options{.start_ns = start_ns, .influencer = &influencer, .history_s = kHistory_s};
    if (!arguments.ordered)
      return {layout_on_mission(*layout, arguments.vehicle, arguments.mission, options).motion};
    expect_simulable(*layout, arguments.vehicle, &influencer);
    auto motion = std::make_unique<OrderedLayout>(*layout, options, std::move(now_ns));
    OrderedLayout* const ordered = motion.get();
    return {std::move(motion), nullptr, ordered};
  }
  const auto& vehicle = std::get<config::VehicleSettings>(chosen);
  if (arguments.ordered) {
    const OrderedMotion::Options options{start_ns, kHistory_s, &influencer, std::move(now_ns)};
    auto motion = std::make_unique<OrderedMotion>(vehicle, options);
    OrderedMotion* const ordered = motion.get();
    return {std::move(motion), ordered, nullptr};
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
