// SPDX-License-Identifier: Apache-2.0
// Any bytes from a Doppler log that sends PD0.
#include "protocols/pd0.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::pd0_target {

NAVCAL_FUZZ(pd0) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<pd0::Scanner>(
      {data, size}, [](const Frame& frame) { static_cast<void>(pd0::decode(frame.bytes)); });
  // Any offsets and data, as if their checksum held.
  static_cast<void>(pd0::decode({data, size}));
  return 0;
}

}  // namespace navcal::fuzz::pd0_target
