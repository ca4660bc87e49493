// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx.h"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <unordered_map>

#include "protocols/crc16.h"
#include "protocols/decimal.h"
#include "protocols/fletcher.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {

/// Rows of ubx_messages.txt: codes and names of generations 5 to 10; none that a FrameId cannot hold.
const char* message_rows();

FrameId id_of(MessageCode code) {
  if (const std::string_view name = name_of(code); !name.empty()) return FrameId(name);
  std::string text;
  append_hex(text, code, 4);
  return FrameId(text);
}

std::optional<MessageCode> code_of(const Frame& frame) {
  if (kind_of(frame) != Kind::ubx) return std::nullopt;
  return get_be<MessageCode>(frame.bytes.data() + 2);
}

std::optional<Bytes> payload_if(Bytes frame, MessageCode code, std::size_t least) {
  if (frame.size() < kOverhead + least || get_be<MessageCode>(frame.data() + 2) != code) return std::nullopt;
  return payload_of(frame);
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

std::string_view name_of(MessageCode code) {
  static const auto kNames = [] {
    std::unordered_map<MessageCode, std::string> names;
    std::istringstream rows(message_rows());
    std::string name;
    for (MessageCode row = 0; rows >> std::hex >> row >> name;) names[row] = name;
    return names;
  }();
  const auto found = kNames.find(code);
  return found == kNames.end() ? std::string_view() : found->second;
}

}  // namespace navcal::protocols::ubx
