// SPDX-License-Identifier: Apache-2.0
// Any bytes from a TRAX compass or to it.
#include "protocols/trax.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::pni_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  static_cast<void>(trax::decode_data(frame.bytes));
  static_cast<void>(trax::decode_sample_count(frame.bytes));
  static_cast<void>(trax::decode_score(frame.bytes));
}

NAVCAL_FUZZ(pni) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<trax::Scanner>({data, size}, decode);
  if (size <= trax::Scanner::kMaxFrameLength - trax::kOverhead) {
    decode({{}, 0, trax::encode_frame(trax::FrameNumber::data, {data, size})});
  }
  return 0;
}

}  // namespace navcal::fuzz::pni_target
