// SPDX-License-Identifier: Apache-2.0
#include "protocols/gps_stream.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::gps_stream_target {

NAVCAL_FUZZ(gps_stream) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<GpsStreamScanner>(
      {data, size}, [](const Frame& frame) { navcal::fuzz::require(frame.id.view().size() >= 2); });
  return 0;
}

}  // namespace navcal::fuzz::gps_stream_target
