// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/option.h"
#include "config/settings.h"

namespace navcal::config {

/// The table [command].
[[nodiscard]] std::vector<Option<Settings>> command_options();

}  // namespace navcal::config
