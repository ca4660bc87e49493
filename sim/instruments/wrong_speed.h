// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/frame.h"

namespace navcal::sim {

/// What a UART set to `heard_baud` makes of bytes sent in one go at `sent_baud` (8N1): it samples the same wire at
/// its own pace. A character whose stop bit is not one reads as 0, as Linux hands it over. Equal speeds change
/// nothing.
[[nodiscard]] std::vector<std::uint8_t> heard_at(protocols::Bytes sent, int sent_baud, int heard_baud);

}  // namespace navcal::sim
