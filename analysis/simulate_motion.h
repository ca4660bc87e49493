// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "analysis/simulate_arguments.h"
#include "sim/recording.h"
#include "sim/state.h"
#include "sim/vehicle/influences.h"

namespace navcal::analysis {

struct SimulatedRun {
  std::unique_ptr<sim::Motion> motion;
  double duration_s = 0;
  sim::CommandPort commands = sim::CommandPort::motor_card;
  std::string remark{};  ///< what is less than was asked for; empty: nothing
};

/// How the vehicle moves, and for how long. `influencer` must outlive the motion. Throws Failure, sim::BadPath,
/// config::Error, sim::UnfitLayout, sim::UnstableVehicle.
[[nodiscard]] SimulatedRun simulate_motion(const SimulateArguments& arguments, sim::VehicleInfluencer& influencer);

}  // namespace navcal::analysis
