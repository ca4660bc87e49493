// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/state.h"

namespace navcal::sim {

/// A table of states with the columns of a path (sim/path.h), so that it can be driven or carried along again: SI
/// units and radians, the fins those of the servos' shafts.
void begin_truth(std::string& out);
void append_truth(std::string& out, double time_s, const State& state);

}  // namespace navcal::sim
