// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/frame.h"

namespace navcal::sim {

/// Bytes that a UART set to `heard_baud` receives when bytes are sent without pause at `sent_baud` (8N1): it
/// samples the same wire at its own rate. A character whose stop bit is wrong reads as 0, as Linux hands it
/// over. Equal speeds change nothing.
[[nodiscard]] std::vector<std::uint8_t> heard_at(protocols::Bytes sent, int sent_baud, int heard_baud);

}  // namespace navcal::sim
