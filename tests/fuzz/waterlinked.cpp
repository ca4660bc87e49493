// SPDX-License-Identifier: Apache-2.0
// Any bytes from a Doppler log that sends text.
#include "protocols/water_linked.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::waterlinked_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  static_cast<void>(water_linked::decode_velocity(frame.bytes));
  static_cast<void>(water_linked::decode_transducer(frame.bytes));
  static_cast<void>(water_linked::decode_position(frame.bytes));
}

NAVCAL_FUZZ(waterlinked) {
  navcal::fuzz::check_stream<navcal::protocols::water_linked::Scanner>({data, size}, decode);
  // Any fields, as if their checksum held.
  decode({{}, 0, {data, size}});
  return 0;
}

}  // namespace navcal::fuzz::waterlinked_target
