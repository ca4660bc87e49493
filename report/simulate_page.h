// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/simulate_arguments.h"
#include "analysis/simulate_history.h"
#include "analysis/simulate_run.h"
#include "sim/effects/effect_set.h"

namespace navcal::report {

/// The page of a simulation: track, heading, depth, speed, fins, and the output of each instrument beside the
/// truth.
[[nodiscard]] std::string simulate_page(const analysis::SimulateHistory& history,
                                        const analysis::SimulateArguments& arguments,
                                        const analysis::SimulatedRun& run, const sim::EffectSet& effects);

}  // namespace navcal::report
