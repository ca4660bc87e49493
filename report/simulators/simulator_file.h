// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/simulators/transfer.h"

namespace navcal::report {

/// The found effects in a file for the simulator (docs/simulator-export.md). A verdict other than "explained"
/// gives a file without any correction, which says so.
[[nodiscard]] SimulatorFile simulator_file(Simulator simulator, const CorrectedModel& model);

}  // namespace navcal::report
