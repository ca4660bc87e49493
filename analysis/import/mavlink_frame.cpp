// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/mavlink_frame.h"

#include <algorithm>

#include "analysis/import/wire_reader.h"

namespace navcal::analysis::mavlink {
namespace {

constexpr std::uint16_t accumulate(std::uint16_t crc, std::uint8_t byte) {
  auto mixed = static_cast<std::uint8_t>(byte ^ (crc & 0xFF));
  mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4));
  return static_cast<std::uint16_t>((crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
}

const MessageInfo* message_of(std::uint32_t id) {
  const auto found =
      std::find_if(kMessages.begin(), kMessages.end(), [&](const MessageInfo& m) { return m.id == id; });
  return found == kMessages.end() ? nullptr : &*found;
}

}  // namespace

std::uint16_t checksum(std::string_view bytes, std::uint8_t extra) {
  std::uint16_t crc = 0xFFFF;
  for (const char byte : bytes) crc = accumulate(crc, static_cast<std::uint8_t>(byte));
  return accumulate(crc, extra);
}

Found find_frame(std::string_view bytes) {
  constexpr std::size_t kHead1 = 6, kHead2 = 10, kChecksum = 2, kSignature = 13;
  if (bytes.empty()) return {Verdict::incomplete, {}};
  const bool is_second = bytes.front() == '\xFD';
  if (!is_second && bytes.front() != '\xFE') return {};
  const std::size_t head = is_second ? kHead2 : kHead1;
  if (bytes.size() < head) return {Verdict::incomplete, {}};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  Frame frame;
  const std::size_t payload = byte(1);
  const bool is_signed = is_second && (byte(2) & 1U) != 0;
  if (is_second && (byte(2) & ~1U) != 0) return {};
  frame.length = head + payload + kChecksum + (is_signed ? kSignature : 0);
  frame.system = byte(is_second ? 5 : 3);
  frame.id = is_second ? byte(7) | std::uint32_t{byte(8)} << 8 | std::uint32_t{byte(9)} << 16 : byte(5);
  frame.message = message_of(frame.id);
  if (bytes.size() < frame.length) return {Verdict::incomplete, frame};
  frame.payload = bytes.substr(head, payload);
  if (frame.message != nullptr) {
    const auto sent = little_endian_at<std::uint16_t>(bytes, head + payload);
    if (checksum(bytes.substr(1, head - 1 + payload), frame.message->crc_extra) != sent) return {};
  }
  return {Verdict::frame, frame};
}

}  // namespace navcal::analysis::mavlink
