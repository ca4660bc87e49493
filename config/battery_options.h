// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/option.h"
#include "config/settings.h"

namespace navcal::config {

/// [battery]
[[nodiscard]] std::vector<Option<Settings>> battery_options();

}  // namespace navcal::config
