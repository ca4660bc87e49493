// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocols/frame.h"

namespace navcal::protocols::described {

/// Checksums that a description can name.
enum class Sum : std::uint8_t {
  none,
  sum8,          ///< sum of the bytes
  negated_sum8,  ///< its two's complement: all bytes and the checksum add up to 0
  sum16,         ///< sum of the bytes, in two bytes (Teledyne PD0)
  xor8,          ///< NMEA 0183
  fletcher16,    ///< two sums of eight bits, the first one sent first (u-blox, MicroStrain)
  crc8,          ///< polynomial 07, start 0
  crc16_ccitt,   ///< polynomial 1021, start FFFF
  crc16_xmodem,  ///< polynomial 1021, start 0
  crc16_modbus,  ///< polynomial 8005 reflected, start FFFF
  crc32,         ///< polynomial 04C11DB7 reflected, start and final xor FFFFFFFF (zip, Ethernet)
};
inline constexpr std::size_t kSumCount = static_cast<std::size_t>(Sum::crc32) + 1;

/// "crc16-ccitt".
[[nodiscard]] std::string_view name_of(Sum sum);
[[nodiscard]] std::optional<Sum> sum_named(std::string_view name);
/// Bytes that a checksum takes in a frame; 0 for none.
[[nodiscard]] std::size_t size_of(Sum sum);
/// The checksum of some bytes. fletcher16 has its first sum in the upper byte.
[[nodiscard]] std::uint32_t sum_of(Sum sum, Bytes bytes);

}  // namespace navcal::protocols::described
