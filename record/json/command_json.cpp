// SPDX-License-Identifier: Apache-2.0
#include "record/json/command_json.h"

#include "record/json/json_object.h"

namespace navcal::record {

void append_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                 std::string_view device, const control::OrderRecord& record) {
  JsonObject json(out, "COMMAND");
  const auto utc = [&](std::string_view key, const std::optional<std::int64_t>& at_ns) {
    at_ns ? json.seconds(key, mapping.to_utc(*at_ns)) : json.null(key);
  };
  utc("time", record.sent_ns ? record.sent_ns : record.asked_ns);
  json.seconds("monotonic", now_ns);
  json.text("device", device);
  json.text("outcome", name_of(record.outcome));
  json.text("source", name_of(record.source));
  json.integer("sequence", static_cast<std::int64_t>(record.sequence));
  json.text("holder", record.holder);
  record.priority ? json.integer("priority", *record.priority) : json.null("priority");
  utc("asked", record.asked_ns);
  utc("sent", record.sent_ns);
  utc("echoed", record.echoed_ns);
  json.number("late_s", record.late_s);
  json.number("shaft_rpm", record.wanted.shaft_rpm);
  json.numbers("fins_deg", record.wanted.fins_deg);
  if (record.sent) {
    json.integer("shaft_sent_rpm", record.sent->rpm);
    json.numbers("fins_sent_deg", record.sent->fins_deg);
  } else {
    json.null("shaft_sent_rpm");
    json.null("fins_sent_deg");
  }
  json.text("reason", record.reason);
  json.integer("refused_since", static_cast<std::int64_t>(record.refused_since));
}

}  // namespace navcal::record
