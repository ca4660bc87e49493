// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_motion.h"

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "emulation/chosen_vehicle.h"
#include "sim/path.h"
#include "sim/vehicle/ordered_helm.h"

namespace navcal::emulation {
namespace {

/// Instruments look back by their latencies, and by as long as this process was stopped.
constexpr double kHistory_s = 600;

/// A vehicle that obeys orders as they come.
template <class Vehicle>
EmulatedMotion ordered(const Vehicle& vehicle, const sim::MotionOptions& options) {
  auto helm = std::make_unique<sim::OrderedHelm>(vehicle);
  const auto order = [start_ns = options.start_ns, helm = helm.get()](
                         std::int64_t t_ns, const std::vector<std::optional<double>>& numbers) {
    helm->order(static_cast<double>(t_ns - start_ns) * 1e-9, numbers);
  };
  EmulatedMotion made;
  made.motion = std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options);
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

EmulatedMotion emulate_motion(const EmulateArguments& arguments, sim::MotionOptions options) {
  const ChosenVehicle vehicle = load_chosen_vehicle(arguments.vehicle);
  options.history_s = kHistory_s;
  options.floats = arguments.ordered;
  if (!arguments.ordered) options.now_ns = {};
  const auto* const layout = std::get_if<config::Layout>(&vehicle);
  if (arguments.ordered) {
    if (layout != nullptr) expect_simulable(*layout, arguments.vehicle, options.influencer);
    return std::visit([&](const auto& chosen) { return ordered(chosen, options); }, vehicle);
  }
  if (layout != nullptr || !arguments.mission.empty())
    return {motion_on_mission(vehicle, arguments.vehicle, arguments.mission, options).motion};
  auto rows = arguments.path.empty() ? sim::default_path() : sim::load_path(arguments.path);
  return {std::make_unique<sim::PathMotion>(std::move(rows), options.start_ns, options.field_world_uT)};
}

}  // namespace navcal::emulation
