// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/settings.h"

namespace navcal::analysis {

/// Which port of the configuration in use each port of a recording is, by its name; -1: there is none, which is
/// said on standard error.
[[nodiscard]] std::vector<int> match_ports(const config::Settings& recorded, const config::Settings& used,
                                           const std::string& file);

}  // namespace navcal::analysis
