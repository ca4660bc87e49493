// SPDX-License-Identifier: Apache-2.0
// Any bytes from a Doppler log that sends text.
#include "protocols/pd6.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::pd6_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  static_cast<void>(pd6::decode_attitude(frame.bytes));
  static_cast<void>(pd6::decode_velocity(frame.bytes));
  static_cast<void>(pd6::decode_distance(frame.bytes));
  static_cast<void>(pd6::decode_timing(frame.bytes));
}

NAVCAL_FUZZ(pd6) {
  navcal::fuzz::check_stream<navcal::protocols::pd6::Scanner>({data, size}, decode);
  // Any fields, as if their checksum held.
  decode({{}, 0, {data, size}});
  return 0;
}

}  // namespace navcal::fuzz::pd6_target
