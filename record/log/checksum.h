// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace navcal::record {

/// CRC-32C (Castagnoli, reflected, RFC 3720), which protects every message of a log. `before` continues an earlier
/// sum. "123456789" gives E3069283.
[[nodiscard]] std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0);

/// CRC-32 of zip and MCAP. `before` as there. "123456789" gives CBF43926.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// `,"crc":"xxxxxxxx"}`: how every JSON message ends. The sum is over all before it.
inline constexpr std::size_t kJsonTail = 18;
/// Direction and arrival before the raw bytes; the sum behind them.
inline constexpr std::size_t kRawHead = 9;
inline constexpr std::size_t kRawTail = 4;

[[nodiscard]] bool json_crc_holds(std::string_view data);
[[nodiscard]] bool raw_crc_holds(std::string_view data);

}  // namespace navcal::record
