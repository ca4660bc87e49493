// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "control/order.h"
#include "pipeline/utc_mapping.h"

namespace navcal::record {

/// Appends what became of an order, COMMAND, as it stands in the log. `now_ns` monotonic: when that was known;
/// `device`: the motor card's port.
void append_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                 std::string_view device, const control::OrderRecord& record);

}  // namespace navcal::record
