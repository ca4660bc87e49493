// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/option.h"
#include "config/settings.h"

namespace navcal::config {

/// The options of the table [instruments].
[[nodiscard]] std::vector<Option<Settings>> instrument_options();

}  // namespace navcal::config
