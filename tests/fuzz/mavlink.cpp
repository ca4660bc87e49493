// SPDX-License-Identifier: Apache-2.0
// Any bytes from an autopilot, and one frame that is always whole.
#include "protocols/mavlink.h"

#include "protocols/mavlink_signer.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::mavlink_target {

void decode(const navcal::protocols::Frame& frame) {
  namespace mavlink = navcal::protocols::mavlink;
  const auto found = mavlink::find_message(frame.bytes);
  navcal::fuzz::require(found.verdict == mavlink::Found::Verdict::frame &&
                        found.message.length == frame.bytes.size());
  const mavlink::Payload payload(found.message.payload);
  static_cast<void>(payload.text(238, 16));
  navcal::fuzz::require(payload.at<std::uint64_t>(255) == 0);
}

NAVCAL_FUZZ(mavlink) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<mavlink::Scanner>({data, size}, decode);
  auto frame = mavlink::encode(30, {1, 1, 0}, Bytes(data, std::min<std::size_t>(size, 255)));
  navcal::fuzz::check_stream<mavlink::Scanner>(frame, decode);
  mavlink::Signer ours({}), theirs({});
  static_cast<void>(theirs.check({data, size}));
  ours.sign(frame);
  navcal::fuzz::check_stream<mavlink::Scanner>(frame, decode);
  navcal::fuzz::require(mavlink::Signer({}).check(frame) == mavlink::Signer::Verdict::good);
  return 0;
}

}  // namespace navcal::fuzz::mavlink_target
