// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/settings.h"
#include "record/port_matching.h"

namespace navcal::analysis {

/// Which port of the configuration in use each port of a recording is. Ports that the configuration lacks are
/// named on standard error.
[[nodiscard]] record::PortMatch match_ports(const config::Settings& recorded, const config::Settings& used,
                                            const std::string& file);

}  // namespace navcal::analysis
