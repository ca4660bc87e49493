// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/settings.h"

namespace navcal::daemon {

/// Describes how the service would act with these settings, for `navcald --check`.
[[nodiscard]] std::string describe(const config::Settings& settings);

}  // namespace navcal::daemon
