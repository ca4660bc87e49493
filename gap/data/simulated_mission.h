// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/data/mission.h"
#include "sim/recording.h"

namespace navcal::gap {

/// Readings that simulated instruments give of a motion, and the commands to its motor card, from
/// options.begin_ns on.
[[nodiscard]] Mission simulated_mission(const sim::Recording::Options& options, const sim::Motion& motion,
                                        double duration_s);

}  // namespace navcal::gap
