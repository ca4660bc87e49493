// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/vehicle.h"
#include "gap/data/mission.h"
#include "gap/inference/library.h"

namespace navcal::gap {

/// Estimates the times of the commands to the motor card, s, for a recording that does not contain them.
///
/// Model: one command every tenth of a second. The phase is the one by which the nominal vehicle predicts its
/// instruments best. The card's reports alone hardly determine it: at ten a second, they sample the response to
/// ten commands a second at one point only.
[[nodiscard]] std::vector<double> likely_order_times_s(const Mission& mission,
                                                       const config::VehicleSettings& vehicle,
                                                       const Library& library, unsigned threads);

}  // namespace navcal::gap
