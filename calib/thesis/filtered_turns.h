// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "calib/turn/turn_filter.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib::test {

/// The filter after all of these readings, told the thesis's own noise.
[[nodiscard]] TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior);

}  // namespace navcal::calib::test
