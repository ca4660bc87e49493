// SPDX-License-Identifier: Apache-2.0
#include "record/json/event_json.h"

#include "record/json/json_object.h"

namespace navcal::record {

void append_event_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                       std::string_view severity, std::string_view name, std::string_view port,
                       std::string_view message) {
  JsonObject json(out, "EVENT");
  json.seconds("time", mapping.to_utc(now_ns));
  json.seconds("monotonic", now_ns);
  json.text("severity", severity);
  json.text("name", name);
  json.text("port", port);
  json.text("message", message);
}

}  // namespace navcal::record
