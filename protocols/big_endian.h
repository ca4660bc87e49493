// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace navcal::protocols {

// Fields of binary messages: big-endian, two's complement.
inline std::uint16_t read_u16(const std::uint8_t* p) { return static_cast<std::uint16_t>(p[0] << 8 | p[1]); }
inline std::int16_t read_i16(const std::uint8_t* p) { return static_cast<std::int16_t>(read_u16(p)); }
inline std::uint32_t read_u32(const std::uint8_t* p) {
  return static_cast<std::uint32_t>(read_u16(p)) << 16 | read_u16(p + 2);
}
inline std::int32_t read_i32(const std::uint8_t* p) { return static_cast<std::int32_t>(read_u32(p)); }

}  // namespace navcal::protocols
