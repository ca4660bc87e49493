#pragma once

#include <string>

#include "analysis/simulate_arguments.h"
#include "analysis/simulate_history.h"
#include "analysis/simulate_motion.h"
#include "sim/effects/effect_set.h"

namespace navcal::cli {

/// The page of a simulation: track, heading, depth, speed, fins, and what each instrument said beside the truth.
[[nodiscard]] std::string simulate_page(const SimulateHistory& history, const SimulateArguments& arguments,
                                        const SimulatedRun& run, const sim::EffectSet& effects);

}  // namespace navcal::cli
