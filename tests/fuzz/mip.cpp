// SPDX-License-Identifier: Apache-2.0
// Any bytes from a MicroStrain sensor.
#include "protocols/mip.h"

#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::mip_target {

NAVCAL_FUZZ(mip) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<mip::Scanner>(
      {data, size}, [](const Frame& frame) { static_cast<void>(mip::decode(frame.bytes)); });
  // Packets with a valid checksum and arbitrary fields.
  if (size > 0 && size < 200) {
    for (const std::uint8_t set : {mip::kBaseSet, mip::kSensorSet, mip::kFilterSet, mip::kSystemSet}) {
      static_cast<void>(mip::decode(mip::encode_fields(set, {{data[0], {data + 1, data + size}}})));
    }
  }
  return 0;
}

}  // namespace navcal::fuzz::mip_target
