// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "config/vehicle.h"

namespace navcal::sim {

/// Current that the motor draws at this shaft speed: I = I0 + k n^3.
[[nodiscard]] inline double current_A(const config::PropellerSettings& propeller, double shaft_rps) {
  const double n = std::max(shaft_rps, 0.0);
  return propeller.idle_current_A + propeller.current_A_s3 * n * n * n;
}

}  // namespace navcal::sim
