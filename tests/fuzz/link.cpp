// SPDX-License-Identifier: Apache-2.0
// Any bytes on the narrow link: to the parser, to both ends of a session, and as payloads of intact frames.
#include "link/host.h"
#include "link/vehicle.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::link_target {

using namespace navcal::link;

EndOptions options_from(std::uint8_t seed) {
  EndOptions options;
  options.nonce = [seed]() mutable {
    Nonce nonce{};
    for (auto& byte : nonce) byte = ++seed;
    return nonce;
  };
  return options;
}

/// Two ends without a key, so that the fuzzer gets past the tags, on a line on which frames of its own come
/// between.
void check_session(const std::uint8_t* data, std::size_t size) {
  Vehicle vehicle(options_from(data[0]));
  Host host(options_from(data[1]));
  std::int64_t now_ns = 1;
  std::size_t at = 2;
  std::uint16_t session = 0;
  std::uint32_t counter = 1;
  while (at + 3 < size) {
    const auto type = static_cast<FrameType>(1 + data[at] % kFrameTypes);
    const std::size_t length = std::min<std::size_t>(data[at + 1] % (kMaxPayload + 1), size - at - 3);
    now_ns += std::int64_t{data[at + 2]} * 20'000'000;
    const Bytes payload(data + at + 3, length);
    at += 3 + length;
    counter += payload.empty() ? 0 : payload[0] % 3;
    const Buffer frame = FrameWriter({type, false, session, counter}, payload).finish({});
    vehicle.take(now_ns, frame);
    host.take(now_ns, frame);
    vehicle.advance(now_ns);
    (void)vehicle.take_events();
    if (const auto command = vehicle.take_command()) vehicle.answer({command->number, true, false, ""});
    while (const auto request = vehicle.take_request()) {
      navcal::fuzz::require(request->size() <= kLongestRequest);
      (void)vehicle.respond(*request);
    }
    (void)host.take_response();
    (void)host.request("a request");
    if (vehicle.is_report_due(now_ns)) vehicle.report(now_ns, Buffer(payload.begin(), payload.end()));
    unsigned sent = 0;
    while (auto out = vehicle.next(now_ns)) {
      const auto view = view_frame(*out);
      navcal::fuzz::require(view.has_value() && ++sent < 100);
      if (view->header.type == FrameType::welcome) session = view->header.session;
      host.take(now_ns, *out);
    }
    while (auto out = host.next(now_ns)) {
      navcal::fuzz::require(view_frame(*out).has_value() && ++sent < 100);
      vehicle.take(now_ns, *out);
    }
    navcal::fuzz::require(vehicle.deadline_ns() > now_ns && host.deadline_ns() > now_ns);
  }
}

NAVCAL_FUZZ(link) {
  navcal::fuzz::check_stream<Scanner>({data, size}, [](const navcal::protocols::Frame& frame) {
    navcal::fuzz::require(view_frame(frame.bytes).has_value());
  });
  if (const auto report = decode_report({data, size})) navcal::fuzz::require(!encode_report(*report).empty());
  if (size > 2) check_session(data, size);
  return 0;
}

}  // namespace navcal::fuzz::link_target
