// SPDX-License-Identifier: Apache-2.0
// Any bytes from or to a motor card.
#include "protocols/motor_card.h"

#include "protocols/checked_line.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::motor_card_target {

void decode(const navcal::protocols::Frame& frame) {
  using namespace navcal::protocols;
  const auto status = motor_card::decode_status(frame.bytes);
  const auto command = motor_card::decode_command(frame.bytes);
  navcal::fuzz::require(!status || frame.id == motor_card::kMcs);
  navcal::fuzz::require(!command || frame.id == motor_card::kMcc);
}

NAVCAL_FUZZ(motor_card) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<motor_card::Scanner>({data, size}, decode);
  // A line with a valid checksum and arbitrary fields.
  const std::string_view body(reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 80));
  const auto line = checked_line(body);
  static_cast<void>(motor_card::decode_status(line));
  static_cast<void>(motor_card::decode_command(line));
  return 0;
}

}  // namespace navcal::fuzz::motor_card_target
