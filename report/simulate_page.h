// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "emulation/simulate_arguments.h"
#include "emulation/simulate_history.h"
#include "emulation/simulate_run.h"
#include "sim/effects/effect_set.h"

namespace navcal::report {

/// The page of a simulation: track, heading, depth, speed, fins, and the output of each instrument beside the
/// truth.
[[nodiscard]] std::string simulate_page(const emulation::SimulateHistory& history,
                                        const emulation::SimulateArguments& arguments,
                                        const emulation::SimulatedRun& run, const sim::EffectSet& effects);

}  // namespace navcal::report
