// SPDX-License-Identifier: Apache-2.0
#include "link/session.h"

#include <utility>

namespace navcal::link {

std::string_view words_for(Refusal refusal) {
  switch (refusal) {
    case Refusal::untagged: return "the vehicle has a key: it takes nothing without that key";
    case Refusal::bad_tag: return "the vehicle has another key";
    case Refusal::no_key: return "the vehicle has no key; connect without one";
    case Refusal::unknown_session:
      return "the vehicle does not know this session: its program was started anew, or another operator came";
    case Refusal::none: break;
  }
  return "";
}

Buffer make_frame(Header header, Bytes payload, const std::optional<SessionKey>& key, Direction direction) {
  header.is_tagged = key.has_value();
  FrameWriter writer(header, payload);
  if (!key) return std::move(writer).finish({});
  const Tag tag = key->tag(direction, writer.covered());
  return std::move(writer).finish(tag);
}

Session::Session(std::uint16_t number, const Nonce& vehicle_nonce, const Nonce& host_nonce,
                 const std::optional<Key>& key, Direction outgoing)
    : id(number), vehicle(vehicle_nonce), host(host_nonce),
      receiver(outgoing == Direction::to_operator ? kLongestRequest : kMaxMessage), outgoing_(outgoing) {
  if (key) key_ = key->session(vehicle, host);
}

Buffer Session::frame(FrameType type, Bytes payload) {
  return make_frame({type, false, id, ++counter_}, payload, key_, outgoing_);
}

End::End(EndOptions options) : options_(std::move(options)), budget_(options_.budget_B_s) {
  if (options_.key) outside_ = options_.key->outside();
}

void End::take(std::int64_t now_ns, Bytes bytes) {
  parser_.feed(bytes, [&](const protocols::Frame& frame) {
    if (const auto view = view_frame(frame.bytes)) take_frame(now_ns, *view);
  });
}

void End::take_of_stream(std::int64_t now_ns, const FrameView& view, Session& session) {
  if (view.header.type == FrameType::segment) {
    if (const auto segment = decode_segment(view.payload))
      session.receiver.take(now_ns, *segment, view.header.counter);
  } else if (const auto ack = decode_ack(view.payload)) {
    session.sender.acknowledge(now_ns, *ack);
  }
}

bool End::allows(std::int64_t now_ns, std::size_t length, bool is_urgent) {
  if (budget_.allows(now_ns, length, is_urgent)) return true;
  wake(budget_.ready_ns(length, is_urgent));
  return false;
}

Buffer End::counted(Buffer frame) {
  budget_.spend(frame.size());
  counters_.sent_bytes += frame.size();
  return frame;
}

std::optional<Buffer> End::next_of_stream(std::int64_t now_ns, Session& session, bool is_heard) {
  if (now_ns >= session.receiver.ack_due_ns()) {
    if (!passes(now_ns, 12)) return std::nullopt;
    return counted(session.frame(FrameType::ack, encode_ack(session.receiver.ack(now_ns))));
  }
  wake(session.receiver.ack_due_ns());
  if (!is_heard) return std::nullopt;
  if (const auto segment = session.sender.due(now_ns)) {
    if (!passes(now_ns, segment->size())) return std::nullopt;
    Buffer frame = session.frame(FrameType::segment, *segment);
    session.sender.sent(now_ns, session.last_counter());
    return counted(std::move(frame));
  }
  wake(session.sender.deadline_ns());
  return std::nullopt;
}

Refusal Session::check(const FrameView& view) const {
  if (!key_) return view.header.is_tagged ? Refusal::no_key : Refusal::none;
  if (!view.header.is_tagged) return Refusal::untagged;
  const auto incoming = outgoing_ == Direction::to_vehicle ? Direction::to_operator : Direction::to_vehicle;
  return key_->verifies(incoming, view.covered, view.tag) ? Refusal::none : Refusal::bad_tag;
}

}  // namespace navcal::link
