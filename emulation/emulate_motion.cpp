// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_motion.h"

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "config/mission_file.h"
#include "emulation/chosen_vehicle.h"
#include "sim/default_path.h"
#include "sim/path.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/ordered_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::emulation {
namespace {

/// Instruments look back by their latencies, and by as long as this process was stopped.
constexpr double kHistory_s = 600;

/// A vehicle that obeys orders as they come.
template <class Vehicle>
EmulatedMotion ordered(const Vehicle& vehicle, const sim::MotionOptions& options,
                       std::function<std::int64_t()> now_ns) {
  auto helm = std::make_unique<sim::OrderedHelm>(vehicle);
  const auto order = [start_ns = options.start_ns, helm = helm.get()](
                         std::int64_t t_ns, const std::vector<std::optional<double>>& numbers) {
    helm->order(static_cast<double>(t_ns - start_ns) * 1e-9, numbers);
  };
  EmulatedMotion made;
  made.motion = std::make_unique<OrderedMotion>(
      std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options), std::move(now_ns));
  if constexpr (std::is_same_v<Vehicle, config::Layout>) {
    made.obey_outputs = order;
  } else {
    made.obey_card = [order](std::int64_t t_ns, const auto& command) {
      const auto& [a, b, c] = command.fins_deg;
      order(t_ns,
            {command.rpm, a * base::kRadiansPerDegree, b * base::kRadiansPerDegree, c * base::kRadiansPerDegree});
    };
  }
  return made;
}

}  // namespace

EmulatedMotion emulate_motion(const EmulateArguments& arguments, std::int64_t start_ns,
                              sim::VehicleInfluencer& influencer, std::function<std::int64_t()> now_ns) {
  const ChosenVehicle chosen = load_chosen_vehicle(arguments.vehicle);
  const sim::MotionOptions options{
      .start_ns = start_ns, .influencer = &influencer, .history_s = kHistory_s, .floats = arguments.ordered};
  if (const auto* layout = std::get_if<config::Layout>(&chosen)) {
    if (!arguments.ordered)
      return {layout_on_mission(*layout, arguments.vehicle, arguments.mission, options).motion};
    expect_simulable(*layout, arguments.vehicle, &influencer);
    return ordered(*layout, options, std::move(now_ns));
  }
  const auto& vehicle = std::get<config::VehicleSettings>(chosen);
  if (arguments.ordered) return ordered(vehicle, options, std::move(now_ns));
  if (!arguments.mission.empty()) {
    auto helm = std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(arguments.mission));
    return {std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options)};
  }
  auto rows = arguments.path.empty() ? sim::default_path() : sim::load_path(arguments.path);
  return {std::make_unique<sim::PathMotion>(std::move(rows), start_ns)};
}

}  // namespace navcal::emulation
