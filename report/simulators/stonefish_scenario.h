// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/simulators/transfer.h"

namespace navcal::report {

/// Found effects as elements of a Stonefish scenario (XML), to be taken over into the user's own: only elements
/// and attributes that an effect changes, without geometry, materials and looks. Comments say what the file
/// contains and what was left out.
[[nodiscard]] SimulatorFile stonefish_scenario(const CorrectedModel& model);

}  // namespace navcal::report
