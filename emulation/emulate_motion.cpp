// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_motion.h"

#include <utility>

#include "base/angles.h"
#include "config/mission_file.h"
#include "emulation/chosen_vehicle.h"
#include "sim/default_path.h"
#include "sim/layout/control/layout_ordered_helm.h"
#include "sim/layout/layout_motion.h"
#include "sim/path.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/ordered_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::emulation {
namespace {

/// Instruments look back by their latencies, and by as long as this process was stopped.
constexpr double kHistory_s = 600;

/// A motion that obeys its helm's orders as they come.
template <class Motion, class Helm, class Vehicle>
std::unique_ptr<sim::Motion> ordered(const Vehicle& vehicle, std::unique_ptr<Helm> helm,
                                     const sim::MotionOptions& options, std::function<std::int64_t()> now_ns) {
  return std::make_unique<OrderedMotion>(std::make_unique<Motion>(vehicle, std::move(helm), options),
                                         std::move(now_ns));
}

}  // namespace

EmulatedMotion emulate_motion(const EmulateArguments& arguments, std::int64_t start_ns,
                              sim::VehicleInfluencer& influencer, std::function<std::int64_t()> now_ns) {
  const ChosenVehicle chosen = load_chosen_vehicle(arguments.vehicle);
  const sim::MotionOptions options{
      .start_ns = start_ns, .influencer = &influencer, .history_s = kHistory_s, .floats = arguments.ordered};
  const auto seconds = [start_ns](std::int64_t t_ns) { return static_cast<double>(t_ns - start_ns) * 1e-9; };
  // An order takes effect at once.
  if (const auto* layout = std::get_if<config::Layout>(&chosen)) {
    if (!arguments.ordered)
      return {layout_on_mission(*layout, arguments.vehicle, arguments.mission, options).motion};
    expect_simulable(*layout, arguments.vehicle, &influencer);
    auto helm = std::make_unique<sim::LayoutOrderedHelm>(*layout);
    const auto obey = [seconds, helm = helm.get()](std::int64_t t_ns, const auto& pulses_us) {
      helm->order(seconds(t_ns), pulses_us);
    };
    return {ordered<sim::LayoutMotion>(*layout, std::move(helm), options, std::move(now_ns)), {}, obey};
  }
  const auto& vehicle = std::get<config::VehicleSettings>(chosen);
  if (arguments.ordered) {
    auto helm = std::make_unique<sim::OrderedHelm>(vehicle);
    const auto obey = [seconds, helm = helm.get()](std::int64_t t_ns, const auto& command) {
      const auto& [a, b, c] = command.fins_deg;
      helm->order(seconds(t_ns), base::kRadiansPerDegree * Eigen::Vector3d(a, b, c), command.rpm / 60.0);
    };
    return {ordered<sim::SimulatedMotion>(vehicle, std::move(helm), options, std::move(now_ns)), obey};
  }
  if (!arguments.mission.empty()) {
    auto helm = std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(arguments.mission));
    return {std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options)};
  }
  auto rows = arguments.path.empty() ? sim::default_path() : sim::load_path(arguments.path);
  return {std::make_unique<sim::PathMotion>(std::move(rows), start_ns)};
}

}  // namespace navcal::emulation
