// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "analysis/simulate_arguments.h"
#include "sim/effects/effect_set.h"

namespace navcal::analysis {

/// The effects asked for, by strength and from the file. Throws Failure.
[[nodiscard]] sim::EffectSet simulate_effects(const SimulateArguments& arguments);

}  // namespace navcal::analysis
