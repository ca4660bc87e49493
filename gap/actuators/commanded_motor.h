// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "config/vehicle.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// Reports that a motor card would give if the nominal servos and shaft followed these commands: first-order lags
/// behind commands that hold until the next one, beginning at rest at the first. One every `step_s`, from the
/// first command until `duration_s`. Times are in s, the current is not measured (NaN). Empty without commands.
[[nodiscard]] std::vector<MotorReading> commanded_motor(std::span<const Order> orders,
                                                        const config::VehicleSettings& vehicle, double duration_s,
                                                        double step_s = 0.1);

/// Puts commanded_motor() in the place of the reports of a mission that has commands and no reports.
void obey_orders(Mission& mission, const config::VehicleSettings& vehicle);

}  // namespace navcal::gap
