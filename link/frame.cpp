// SPDX-License-Identifier: Apache-2.0
#include "link/frame.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "protocols/crc16.h"
#include "protocols/wire_fields.h"

namespace navcal::link {
namespace {

constexpr std::size_t kKind = 2;
constexpr std::size_t kLength = 3;
constexpr std::size_t kSession = 4;
constexpr std::size_t kCounter = 6;
constexpr std::uint8_t kTagged = 0x80;

constexpr std::array<std::string_view, kFrameTypes + 1> kFrameNames{
    "", "HELLO", "WELCOME", "REFUSAL", "BYE", "PING", "PONG", "REPORT", "COMMAND", "ANSWER", "SEGMENT", "ACK"};

bool is_kind(std::uint8_t kind) {
  const std::uint8_t type = kind & 0x0F;
  return (kind & 0x70) == kVersion << 4 && type >= 1 && type <= kFrameTypes;
}

}  // namespace

protocols::Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  using protocols::Scan;
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != kSync1) return Scan::not_a_frame();
  if (available > kKind && !is_kind(first[kKind])) return Scan::not_a_frame();
  if (available > kLength && first[kLength] > kMaxPayload) return Scan::not_a_frame();
  if (available <= kLength) return Scan::incomplete(kHeaderLength + kCrcLength - available);
  const std::size_t tag = (first[kKind] & kTagged) != 0 ? kTagLength : 0;
  const std::size_t body = kHeaderLength + first[kLength] + tag;
  const std::size_t length = body + kCrcLength;
  if (available < length) return Scan::incomplete(length - available);
  if (protocols::crc32({first + kKind, body - kKind}) != protocols::get_be<std::uint32_t>(first + body))
    return Scan::bad_checksum();
  return Scan::frame(length, protocols::FrameId(kFrameNames.at(first[kKind] & 0x0FU)));
}

std::optional<FrameView> view_frame(Bytes frame) {
  if (frame.size() < kHeaderLength + kCrcLength || frame[0] != kSync0) return std::nullopt;
  const auto scan = Scanner::scan(frame.data(), frame.data() + frame.size());
  if (scan.kind != protocols::Scan::Kind::frame || scan.length != frame.size()) return std::nullopt;
  FrameView view;
  const std::uint8_t* const p = frame.data();
  view.header.type = static_cast<FrameType>(p[kKind] & 0x0F);
  view.header.is_tagged = (p[kKind] & kTagged) != 0;
  view.header.session = protocols::get_be<std::uint16_t>(p + kSession);
  view.header.counter = protocols::get_be<std::uint32_t>(p + kCounter);
  view.payload = frame.subspan(kHeaderLength, p[kLength]);
  const std::size_t body = kHeaderLength + view.payload.size();
  view.covered = frame.subspan(kKind, body - kKind);
  if (view.header.is_tagged) view.tag = frame.subspan(body, kTagLength);
  return view;
}

FrameWriter::FrameWriter(const Header& header, Bytes payload) {
  payload = payload.first(std::min(payload.size(), kMaxPayload));
  bytes_.reserve(kMaxFrame);
  const auto kind =
      static_cast<std::uint8_t>((header.is_tagged ? kTagged : 0) | kVersion << 4 | static_cast<int>(header.type));
  bytes_ = {kSync0,
            kSync1,
            kind,
            static_cast<std::uint8_t>(payload.size()),
            static_cast<std::uint8_t>(header.session >> 8),
            static_cast<std::uint8_t>(header.session)};
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes_.push_back(static_cast<std::uint8_t>(header.counter >> shift));
  bytes_.insert(bytes_.end(), payload.begin(), payload.end());
}

Buffer FrameWriter::finish(Bytes tag) && {
  if ((bytes_[kKind] & kTagged) != 0) {
    for (std::size_t i = 0; i < kTagLength; ++i) bytes_.push_back(i < tag.size() ? tag[i] : 0);
  }
  const std::uint32_t crc = protocols::crc32(covered());
  for (int shift = 24; shift >= 0; shift -= 8) bytes_.push_back(static_cast<std::uint8_t>(crc >> shift));
  return std::move(bytes_);
}

}  // namespace navcal::link
