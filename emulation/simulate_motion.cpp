// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "base/failure.h"
#include "config/mission_file.h"
#include "config/vehicle_file.h"
#include "emulation/chosen_vehicle.h"
#include "emulation/simulate_run.h"
#include "sim/motion_in_field.h"
#include "sim/path.h"
#include "sim/vehicle/drive_helm.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::emulation {
namespace {

SimulatedRun along_path(const SimulateArguments& arguments) {
  auto path = std::make_unique<sim::PathMotion>(sim::load_path(arguments.path), arguments.begin_ns);
  const double duration_s = arguments.seconds.value_or(path->duration_s());
  return {std::move(path), duration_s, sim::CommandPort::motor_card, {}};
}

SimulatedRun with_layout(const config::Layout& layout, const SimulateArguments& arguments,
                         const sim::MotionOptions& options) {
  if (!arguments.drive.empty())
    throw base::Failure(base::Exit::usage,
                        fmt::format("{} is a layout, and --drive moves one propeller and three fins: a layout "
                                    "takes --mission",
                                    arguments.vehicle.string()));
  LayoutOnMission run = layout_on_mission(layout, arguments.vehicle, arguments.mission, options);
  const double duration_s = arguments.seconds ? *arguments.seconds : run.motion->duration_s();
  return {std::move(run.motion), duration_s, sim::CommandPort::outputs, std::move(run.remark)};
}

SimulatedRun with_three_fins(const config::VehicleSettings& vehicle, const SimulateArguments& arguments,
                             const sim::MotionOptions& options) {
  std::unique_ptr<sim::Helm> helm;
  if (!arguments.drive.empty()) {
    helm = std::make_unique<sim::DriveHelm>(sim::load_path(arguments.drive));
  } else {
    helm = std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(arguments.mission));
  }
  auto motion = std::make_unique<sim::SimulatedMotion>(vehicle, std::move(helm), options);
  const double duration_s = arguments.seconds ? *arguments.seconds : motion->duration_s();
  return {std::move(motion), duration_s, sim::CommandPort::motor_card, {}};
}

SimulatedRun under_way(const SimulateArguments& arguments, sim::VehicleInfluencer& influencer) {
  sim::MotionOptions options;
  options.start_ns = arguments.begin_ns;
  options.influencer = &influencer;
  if (arguments.layout) return with_layout(*arguments.layout, arguments, options);
  const auto vehicle =
      arguments.vehicle.empty() ? config::VehicleSettings{} : config::load_vehicle(arguments.vehicle);
  return with_three_fins(vehicle, arguments, options);
}

}  // namespace

SimulatedRun simulate_motion(const SimulateArguments& arguments, sim::VehicleInfluencer& influencer) {
  SimulatedRun run = arguments.path.empty() ? under_way(arguments, influencer) : along_path(arguments);
  run.motion = std::make_unique<sim::MotionInField>(std::move(run.motion), arguments.place.field_world_uT);
  return run;
}

}  // namespace navcal::emulation
