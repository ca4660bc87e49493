// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace navcal::record {

/// `,"crc":"xxxxxxxx"}`: how every JSON message ends. The sum is over all before it.
inline constexpr std::size_t kJsonTail = 18;
/// Direction and arrival before the raw bytes; the sum behind them.
inline constexpr std::size_t kRawHead = 9;
inline constexpr std::size_t kRawTail = 4;

[[nodiscard]] bool json_crc_holds(std::string_view data);
[[nodiscard]] bool raw_crc_holds(std::string_view data);

}  // namespace navcal::record
