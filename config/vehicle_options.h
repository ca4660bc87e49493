// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/option.h"
#include "config/vehicle.h"

namespace navcal::config {

/// Every setting of a vehicle, table by table.
[[nodiscard]] const std::vector<Option<VehicleSettings>>& vehicle_options();

}  // namespace navcal::config
