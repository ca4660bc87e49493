// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/option.h"
#include "config/settings.h"

namespace navcal::config {

/// The options of [calibration], for daemon_options().
[[nodiscard]] std::vector<Option<Settings>> calibration_options();

}  // namespace navcal::config
