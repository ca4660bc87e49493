// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "pipeline/utc_mapping.h"

namespace navcal::record {

/// Appends an event as it stands in the log. `now_ns` monotonic; `port` empty: of no port.
void append_event_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                       std::string_view severity, std::string_view name, std::string_view port,
                       std::string_view message);

}  // namespace navcal::record
