// SPDX-License-Identifier: Apache-2.0
// Any bytes from a Paroscientific gauge or to it.
#include "protocols/paroscientific.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::paroscientific_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  static_cast<void>(paroscientific::address_of(frame.bytes));
  static_cast<void>(paroscientific::decode_value(frame.bytes));
  static_cast<void>(paroscientific::parameter_of(frame.bytes));
}

NAVCAL_FUZZ(paroscientific) {
  navcal::fuzz::check_stream<navcal::protocols::paroscientific::Scanner>({data, size}, decode);
  return 0;
}

}  // namespace navcal::fuzz::paroscientific_target
