// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/simulators/transfer.h"

namespace navcal::report {

/// Found effects as SIM_* parameters of ArduPilot SITL (ArduSub 4.7): a file for `sim_vehicle.py --add-param-file`
/// and for MAVProxy's `param load`. One "NAME value" a line; comments begin with # and, since ArduPilot reads
/// lines of at most 98 characters, are shorter than that.
[[nodiscard]] SimulatorFile sitl_parameters(const CorrectedModel& model);

}  // namespace navcal::report
