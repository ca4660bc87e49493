// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "analysis/simulate_arguments.h"
#include "analysis/simulate_history.h"
#include "analysis/simulate_motion.h"
#include "record/log/log_info.h"
#include "sim/effects/effect_set.h"

namespace navcal::analysis {

/// Writes the capture, and the truth if it is wanted: both whole or not at all. `history` may be null. `progress`
/// gets the share that is done, 0 to 1; what it throws ends the simulation, and nothing is written then. Throws
/// std::system_error.
void write_simulation(const SimulateArguments& arguments, const SimulatedRun& run, sim::EffectSet& effects,
                      SimulateHistory* history, const record::Progress& progress);

}  // namespace navcal::analysis
