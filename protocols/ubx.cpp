// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx.h"

#include <array>
#include <cassert>

#include "protocols/fletcher.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";

/// CRC-24Q (RTCM 10403.3, 4.2): polynomial 0x1864CFB, start 0, not reflected.
constexpr auto kCrc24Table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte << 16;
    for (int bit = 0; bit < 8; ++bit) {
      remainder <<= 1;
      if ((remainder & 0x1000000U) != 0) remainder ^= 0x1864CFBU;
    }
    table[byte] = remainder;
  }
  return table;
}();

std::uint32_t crc24q(Bytes bytes) {
  std::uint32_t crc = 0;
  for (const std::uint8_t byte : bytes) crc = ((crc << 8) & 0xFFFFFFU) ^ kCrc24Table[(crc >> 16) ^ byte];
  return crc;
}

}  // namespace

FrameId id_of(MessageCode code) {
  if (const std::string_view name = name_of(code); !name.empty()) return FrameId(name);
  std::array<char, 4> text{};
  for (std::size_t i = 0; i < 4; ++i) text[i] = kHexDigits[code >> (12 - 4 * i) & 0xFU];
  return FrameId(std::string_view(text.data(), text.size()));
}

std::optional<MessageCode> code_of(const Frame& frame) {
  if (kind_of(frame) != Kind::ubx) return std::nullopt;
  return get_be<MessageCode>(frame.bytes.data() + 2);
}

Kind kind_of(const Frame& frame) {
  if (frame.bytes[0] == 0xB5) return Kind::ubx;
  return frame.bytes[0] == 0xD3 ? Kind::rtcm3 : Kind::nmea;
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != 0x62) return Scan::not_a_frame();
  if (available < 6) return Scan::incomplete(kOverhead - available);
  const std::size_t payload = get_le<std::uint16_t>(first + 4);
  if (payload > kMaxPayload) return Scan::not_a_frame();
  const std::size_t length = kOverhead + payload;
  if (available < length) return Scan::incomplete(length - available);
  const Fletcher sum = fletcher_of(Bytes(first + 2, length - 4));
  if (sum != Fletcher{first[length - 2], first[length - 1]}) return Scan::bad_checksum();
  return Scan::frame(length, id_of(get_be<MessageCode>(first + 2)));
}

Scan Rtcm3Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  constexpr std::size_t kRtcmOverhead = 6;
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && (first[1] & 0xFCU) != 0) return Scan::not_a_frame();
  if (available < 3) return Scan::incomplete(kRtcmOverhead - available);
  const std::size_t length = kRtcmOverhead + get_be<std::uint16_t>(first + 1);
  if (available < length) return Scan::incomplete(length - available);
  const std::uint8_t* const crc = first + length - 3;
  if (crc24q(Bytes(first, length - 3)) != (std::uint32_t{crc[0]} << 16 | get_be<std::uint16_t>(crc + 1))) {
    return Scan::bad_checksum();
  }
  return Scan::frame(length, kRtcm3);
}

Scan PortScanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  if (*first == 0xB5) return Scanner::scan(first, last);
  return *first == 0xD3 ? Rtcm3Scanner::scan(first, last) : nmea::Scanner::scan(first, last);
}

std::vector<std::uint8_t> encode_frame(MessageCode code, Bytes payload) {
  assert(payload.size() <= kMaxPayload);
  std::vector<std::uint8_t> frame(kOverhead + payload.size());
  frame[0] = 0xB5;
  frame[1] = 0x62;
  put_be(&frame[2], code);
  put_le(&frame[4], static_cast<std::uint16_t>(payload.size()));
  std::copy(payload.begin(), payload.end(), frame.begin() + 6);
  const Fletcher sum = fletcher_of(Bytes(frame).subspan(2, frame.size() - 4));
  frame[frame.size() - 2] = sum.first;
  frame[frame.size() - 1] = sum.second;
  return frame;
}

}  // namespace navcal::protocols::ubx
