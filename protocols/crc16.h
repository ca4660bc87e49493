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

/// CRC-16/MODBUS: polynomial 0x8005 reflected, start 0xFFFF; "123456789" gives 0x4B37. Keller uses it.
[[nodiscard]] std::uint16_t crc16_modbus(Bytes bytes);

/// CRC-16/MCRF4XX: polynomial 0x1021 reflected, start 0xFFFF; "123456789" gives 0x6F91. MAVLink uses it.
[[nodiscard]] std::uint16_t crc16_mcrf4xx(Bytes bytes);

// Of other widths, a byte at a time.

/// Polynomial 0x07, start 0, not reflected, no final xor; "123456789" gives 0xF4. Water Linked uses it.
[[nodiscard]] std::uint8_t crc8(Bytes bytes);
/// CRC-24Q (RTCM 10403.3, 4.2): polynomial 0x1864CFB, start 0, not reflected.
[[nodiscard]] std::uint32_t crc24q(Bytes bytes);
/// Polynomial 0x04C11DB7 reflected, start and final xor 0xFFFFFFFF (zip, Ethernet); "123456789" gives 0xCBF43926.
[[nodiscard]] std::uint32_t crc32(Bytes bytes);

}  // namespace navcal::protocols
