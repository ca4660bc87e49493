// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/settings.h"

namespace navcal::daemon {

/// What the service would do with these settings, for `navcald --check`.
[[nodiscard]] std::string describe(const config::Settings& settings);

}  // namespace navcal::daemon
