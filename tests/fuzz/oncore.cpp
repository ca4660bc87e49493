// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore.h"

#include "protocols/oncore_command.h"
#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::oncore_target {

namespace oncore = navcal::protocols::oncore;
using navcal::protocols::Bytes;

void decode_everything(Bytes bytes) {
  if (const auto position = oncore::decode_position(bytes); position && position->in_range) {
    navcal::fuzz::require(position->heading_deg >= 0 && position->heading_deg < 360);
    const auto date = navcal::protocols::correct_rollover(position->date);
    navcal::fuzz::require(is_valid(date.date));
  }
  static_cast<void>(oncore::decode_bb(bytes));
  static_cast<void>(oncore::decode_bo(bytes));
  static_cast<void>(oncore::decode_gj(bytes));
  static_cast<void>(oncore::decode_hn(bytes));
  static_cast<void>(oncore::decode_cj(bytes));
}

NAVCAL_FUZZ(oncore) {
  const Bytes input(data, size);
  navcal::fuzz::check_stream<oncore::Scanner>(input, [](const auto& frame) { decode_everything(frame.bytes); });
  navcal::fuzz::check_stream<oncore::CommandScanner>(
      input, [](const auto& frame) { navcal::fuzz::require(oncore::parse_command(frame.bytes).has_value()); });
  decode_everything(input);  // decoders may be handed anything
  static_cast<void>(oncore::parse_command(input));
  return 0;
}

}  // namespace navcal::fuzz::oncore_target
