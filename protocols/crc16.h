// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocols/frame.h"

namespace navcal::protocols {

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected, no final xor; "123456789" gives 0x29B1
/// (ICD section 3). Own code, as this folder stands on the standard library alone and Boost.CRC takes one byte at
/// a time.
[[nodiscard]] std::uint16_t crc16_ccitt_false(Bytes bytes);

/// CRC-16/XMODEM: the same polynomial with start 0; "123456789" gives 0x31C3. PNI and VectorNav use it.
[[nodiscard]] std::uint16_t crc16_xmodem(Bytes bytes);

/// CRC-16/MODBUS: polynomial 0x8005 reflected, start 0xFFFF; "123456789" gives 0x4B37. Keller uses it. Its frames
/// have ten bytes at most, so one bit at a time is quick enough.
[[nodiscard]] std::uint16_t crc16_modbus(Bytes bytes);

/// CRC-16/MCRF4XX: polynomial 0x1021 reflected, start 0xFFFF; "123456789" gives 0x6F91. MAVLink uses it.
[[nodiscard]] std::uint16_t crc16_mcrf4xx(Bytes bytes);

}  // namespace navcal::protocols
