// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "calib/thesis/measured_path.h"
#include "calib/turn/turn_filter.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib::thesis {

/// The filter before any reading, told the thesis's own noise.
[[nodiscard]] TurnFilter turn_filter(const TurnPrior& prior);
/// The turn between readings, in their order; the first steps belong to the first readings.
[[nodiscard]] std::vector<TurnStep> turn_steps(std::span<const Measured> readings);
/// The filter after all of these readings, told the thesis's own noise.
[[nodiscard]] TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior);

}  // namespace navcal::calib::thesis
