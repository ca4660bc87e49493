// SPDX-License-Identifier: Apache-2.0
// Any bytes from a VectorNav sensor.
#include "protocols/vectornav.h"

#include "protocols/checked_line.h"
#include "protocols/vectornav_lines.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::vectornav_target {

NAVCAL_FUZZ(vectornav) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<vectornav::Scanner>({data, size}, [](const Frame& frame) {
    static_cast<void>(vectornav::decode_binary(frame.bytes));
    static_cast<void>(vectornav::decode_line(frame.bytes));
    static_cast<void>(vectornav::decode_register(frame.bytes));
    static_cast<void>(vectornav::decode_error(frame.bytes));
  });
  const std::string_view body(reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 200));
  static_cast<void>(vectornav::decode_line(checked_line(body)));
  return 0;
}

}  // namespace navcal::fuzz::vectornav_target
