// SPDX-License-Identifier: Apache-2.0
// Any bytes on the bus of Keller transmitters.
#include "protocols/keller.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::keller_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  static_cast<void>(keller::decode_reading(frame.bytes));
  static_cast<void>(keller::decode_identity(frame.bytes));
  static_cast<void>(keller::decode_refusal(frame.bytes));
  static_cast<void>(keller::requested_channel(frame.bytes));
}

NAVCAL_FUZZ(keller) {
  navcal::fuzz::check_stream<navcal::protocols::keller::Scanner>({data, size}, decode);
  // Any bytes, as if their checksum held.
  decode({{}, 0, {data, size}});
  return 0;
}

}  // namespace navcal::fuzz::keller_target
