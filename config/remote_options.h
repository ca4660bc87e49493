// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/options.h"

namespace navcal::config {

/// The table [remote].
[[nodiscard]] std::vector<Option<Settings>> remote_options();

}  // namespace navcal::config
