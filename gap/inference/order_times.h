// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/vehicle.h"
#include "gap/data/mission.h"
#include "gap/inference/library.h"

namespace navcal::gap {

/// When the motor card was told something, of a recording that does not say so: every tenth of a second, at that
/// time after the whole ones by which the nominal vehicle foretells its instruments best. The reports themselves
/// can hardly tell: ten a second show orders of ten a second at one place only.
[[nodiscard]] std::vector<double> likely_order_times_s(const Mission& mission,
                                                       const config::VehicleSettings& vehicle,
                                                       const Library& library, unsigned threads);

}  // namespace navcal::gap
