// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "emulation/simulate_arguments.h"
#include "emulation/simulate_history.h"
#include "record/log/log_info.h"
#include "sim/effects/effect_set.h"
#include "sim/recording.h"
#include "sim/state.h"
#include "sim/vehicle/influences.h"

namespace navcal::emulation {

struct SimulatedRun {
  std::unique_ptr<sim::Motion> motion;
  double duration_s = 0;
  sim::CommandPort commands = sim::CommandPort::motor_card;
  std::string remark{};  ///< what is less than was asked for; empty: nothing
};

/// Motion of the vehicle, and its duration. `influencer` must outlive the motion. Throws Failure,
/// config::Error, sim::UnfitLayout, sim::UnstableVehicle.
[[nodiscard]] SimulatedRun simulate_motion(const SimulateArguments& arguments, sim::VehicleInfluencer& influencer);

/// The effects asked for, by strength and from the file. Throws Failure.
[[nodiscard]] sim::EffectSet simulate_effects(const SimulateArguments& arguments);

/// Writes the capture, and the truth if it is wanted: both whole or not at all. `history` may be null. `progress`
/// gets the share that is done, 0 to 1; what it throws ends the simulation, and nothing is written then. Throws
/// std::system_error.
void write_simulation(const SimulateArguments& arguments, const SimulatedRun& run, sim::EffectSet& effects,
                      SimulateHistory* history, const record::Progress& progress);

}  // namespace navcal::emulation
