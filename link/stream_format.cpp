// SPDX-License-Identifier: Apache-2.0
#include "link/fields.h"
#include "link/stream.h"

namespace navcal::link {
namespace {

constexpr std::uint8_t kLast = 1;

void lay_out_ack(auto& fields, auto& ack) {
  fields.number(ack.next);
  fields.number(ack.others);
  fields.number(ack.counter);
  fields.number(ack.held_ms);
}

}  // namespace

Buffer encode_segment(const Segment& segment) {
  FieldWriter out;
  out.put(segment.number);
  out.put(static_cast<std::uint8_t>(segment.is_last ? kLast : 0));
  out.put_bytes(segment.data);
  return std::move(out).take();
}

std::optional<Segment> decode_segment(Bytes payload) {
  FieldReader in(payload);
  Segment segment;
  segment.number = in.get<std::uint16_t>();
  const auto flags = in.get<std::uint8_t>();
  if (!in.is_whole() || flags > kLast || in.rest().size() > kSegmentBytes) return std::nullopt;
  segment.is_last = flags == kLast;
  segment.data = in.rest();
  return segment;
}

Buffer encode_ack(const Ack& ack) {
  FieldWriter out;
  lay_out_ack(out, ack);
  return std::move(out).take();
}

std::optional<Ack> decode_ack(Bytes payload) {
  FieldReader in(payload);
  Ack ack;
  lay_out_ack(in, ack);
  return in.is_all() ? std::optional(ack) : std::nullopt;
}

}  // namespace navcal::link
