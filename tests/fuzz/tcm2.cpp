// SPDX-License-Identifier: Apache-2.0
// Any bytes from a TCM2 and, as commands, to one.
#include "protocols/tcm2.h"

#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/tcm2_commands.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::tcm2_target {

NAVCAL_FUZZ(tcm2) {
  using namespace navcal::protocols;
  navcal::fuzz::check_stream<tcm2::Scanner>({data, size}, [](const Frame& frame) {
    if (frame.id == tcm2::kReply) {
      const auto reply = tcm2::decode_reply(frame.bytes);
      navcal::fuzz::require(reply.has_value());
      if (reply->kind == tcm2::Reply::Kind::calibration) return;  // its decimals are not kept
      navcal::fuzz::require(tcm2::decode_reply(tcm2::encode_reply(*reply)) == reply);
    } else if (frame.id == tcm2::kWord) {
      static_cast<void>(tcm2::decode_word(frame.bytes));
    } else if (frame.id == tcm2::kHchdm) {
      static_cast<void>(tcm2::decode_hchdm(frame.bytes));
    }
  });
  navcal::fuzz::check_stream<tcm2::CommandScanner>({data, size}, [](const Frame& frame) {
    const auto parsed =
        tcm2::parse_command({reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size()});
    if (const auto* command = std::get_if<tcm2::Command>(&parsed)) {
      const auto sent = tcm2::encode_command(*command);
      navcal::fuzz::require(tcm2::parse_command({reinterpret_cast<const char*>(sent.data()), sent.size()}) ==
                            parsed);
    }
  });
  // A line with a valid checksum and arbitrary fields: a decoded value that is printed decodes to itself.
  const std::string_view body(reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 80));
  if (const auto word = tcm2::decode_word(checked_line(body)); word && word->error) {
    navcal::fuzz::require(tcm2::decode_word(tcm2::encode_word({.error = word->error})) ==
                          tcm2::Word{.error = word->error});
  }
  return 0;
}

}  // namespace navcal::fuzz::tcm2_target
