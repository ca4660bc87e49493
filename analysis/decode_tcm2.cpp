// SPDX-License-Identifier: Apache-2.0
#include <fmt/compile.h>
#include <fmt/format.h>

#include "analysis/decode_describe.h"
#include "protocols/tcm2.h"

namespace navcal::analysis {
namespace {

namespace tcm2 = protocols::tcm2;

constexpr std::string_view kKinds[] = {"accepted", "refused", "value", "calibration"};

void write_error(FieldWriter& fields, const std::optional<std::uint32_t>& error) {
  if (!error) return fields.null("error");
  char digits[8];
  const char* const end = fmt::format_to(digits, FMT_COMPILE("{:03X}"), *error);
  fields.text("error", {digits, static_cast<std::size_t>(end - digits)});
}

void write(FieldWriter& fields, const tcm2::Word& word) {
  fields.number("heading_deg", word.heading);
  fields.number("pitch_deg", word.pitch);
  fields.number("roll_deg", word.roll);
  fields.numbers("field_uT", word.field());
  fields.number("temperature_C", word.temperature);
  write_error(fields, word.error);
}

void write(FieldWriter& fields, const tcm2::Reply& reply) {
  fields.text("reply", kKinds[static_cast<std::size_t>(reply.kind)]);
  switch (reply.kind) {
    case tcm2::Reply::Kind::accepted: break;
    case tcm2::Reply::Kind::refused: write_error(fields, reply.error); break;
    case tcm2::Reply::Kind::value:
      fields.text("parameter", reply.parameter);
      fields.text("value", reply.value);
      break;
    case tcm2::Reply::Kind::calibration:
      fields.number("horizontal", reply.score.horizontal);
      fields.number("vertical", reply.score.vertical);
      fields.number("magnitude", reply.score.magnitude);
      break;
  }
}

}  // namespace

void describe_tcm2(FieldWriter& fields, const protocols::Frame& frame) {
  if (frame.id == tcm2::kWord) {
    const auto word = tcm2::decode_word(frame.bytes);
    write(fields, word.value_or(tcm2::Word{}));
    if (!word) write_out_of_range(fields);
  } else if (frame.id == tcm2::kHchdm) {
    fields.number("heading_deg", tcm2::decode_hchdm(frame.bytes));
  } else if (frame.id == tcm2::kReply) {
    if (const auto reply = tcm2::decode_reply(frame.bytes)) return write(fields, *reply);
    write_out_of_range(fields);
  }
}

}  // namespace navcal::analysis
