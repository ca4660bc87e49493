// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "base/failure.h"
#include "config/vehicle_file.h"
#include "emulation/chosen_vehicle.h"
#include "emulation/simulate_run.h"
#include "sim/path.h"
#include "sim/vehicle/drive_helm.h"

namespace navcal::emulation {
namespace {

MotionOnMission driven(const ChosenVehicle& vehicle, const SimulateArguments& arguments,
                       const sim::MotionOptions& options) {
  const auto* three_fins = std::get_if<config::VehicleSettings>(&vehicle);
  if (three_fins == nullptr)
    throw base::Failure(
        base::Exit::usage,
        fmt::format("{} is a layout, and --drive moves one propeller and three fins: a layout takes --mission",
                    arguments.vehicle.string()));
  auto helm = std::make_unique<sim::DriveHelm>(sim::load_path(arguments.drive));
  return {std::make_unique<sim::SimulatedMotion>(*three_fins, std::move(helm), options), {}};
}

ChosenVehicle vehicle_of(const SimulateArguments& arguments) {
  if (arguments.layout) return *arguments.layout;
  return arguments.vehicle.empty() ? config::VehicleSettings{} : config::load_vehicle(arguments.vehicle);
}

}  // namespace

SimulatedRun simulate_motion(const SimulateArguments& arguments, sim::VehicleInfluencer& influencer) {
  if (!arguments.path.empty()) {
    auto path = std::make_unique<sim::PathMotion>(sim::load_path(arguments.path), arguments.begin_ns,
                                                  arguments.place.field_world_uT);
    const double duration_s = arguments.seconds.value_or(path->duration_s());
    return {std::move(path), duration_s, sim::CommandPort::motor_card, {}};
  }
  const sim::MotionOptions options{
      .start_ns = arguments.begin_ns, .influencer = &influencer, .field_world_uT = arguments.place.field_world_uT};
  const ChosenVehicle vehicle = vehicle_of(arguments);
  MotionOnMission run = arguments.drive.empty()
                            ? motion_on_mission(vehicle, arguments.vehicle, arguments.mission, options)
                            : driven(vehicle, arguments, options);
  const double duration_s = arguments.seconds ? *arguments.seconds : run.motion->duration_s();
  return {std::move(run.motion), duration_s,
          arguments.layout ? sim::CommandPort::outputs : sim::CommandPort::motor_card, std::move(run.remark)};
}

}  // namespace navcal::emulation
