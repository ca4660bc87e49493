// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "web/outlets/exposition.h"

namespace navcal::web {

/// The ports of all lines of one HEALTH: state, counters, clock and latency.
void append_ports(Exposition& out, const std::vector<nlohmann::json>& health_parts);

}  // namespace navcal::web
