// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "analysis/decode_describe.h"
#include "protocols/imu_card.h"
#include "protocols/mavlink.h"
#include "protocols/motor_card.h"

namespace navcal::analysis {

using protocols::Date;
using protocols::Frame;

void describe_imu_card(FieldWriter& fields, const Frame& frame) {
  const auto record = protocols::imu_card::decode_record(frame.bytes);
  if (!record) return write_out_of_range(fields);
  fields.number("sequence", record->sequence);
  fields.number("status", record->status);
  fields.begin_list("channels");
  for (const std::uint16_t raw : record->raw) fields.number({}, raw / 16.0, 4);
  fields.end_list();
}

void describe_motor_card(FieldWriter& fields, const Frame& frame) {
  namespace motor_card = protocols::motor_card;
  if (frame.id == motor_card::kMcc) {
    const auto command = motor_card::decode_command(frame.bytes);
    if (!command) return write_out_of_range(fields);
    fields.number("rpm_commanded", command->rpm);
    return fields.numbers("fins_deg", command->fins_deg);
  }
  const auto decoded = motor_card::decode_status(frame.bytes);
  const motor_card::Status status = decoded.value_or(motor_card::Status{});
  fields.number("sequence", status.sequence);
  fields.number("rpm_commanded", status.rpm_commanded);
  fields.number("rpm", status.rpm);
  fields.numbers("fins_deg", status.fins_deg);
  fields.number("current_A", status.current_A);
  if (!decoded) write_out_of_range(fields);
}

void describe_mavlink(FieldWriter& fields, const Frame& frame) {
  const auto message = protocols::mavlink::find_message(frame.bytes).message;
  fields.text("message", message.name());
  fields.number("system", message.system);
  fields.number("component", message.component);
  if (message.is_signed) fields.flag("signed", true);
  if (message.is_untrimmed) fields.flag("untrimmed", true);
  fields.text("payload", fmt::format("{:02x}", fmt::join(message.payload, "")));
}

}  // namespace navcal::analysis
