// SPDX-License-Identifier: Apache-2.0
#include "link/session.h"

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

Refusal Session::check(const FrameView& view) const {
  if (!key_) return view.header.is_tagged ? Refusal::no_key : Refusal::none;
  if (!view.header.is_tagged) return Refusal::untagged;
  const auto incoming = outgoing_ == Direction::to_vehicle ? Direction::to_operator : Direction::to_vehicle;
  return key_->verifies(incoming, view.covered, view.tag) ? Refusal::none : Refusal::bad_tag;
}

}  // namespace navcal::link
