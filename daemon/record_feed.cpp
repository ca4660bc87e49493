// SPDX-License-Identifier: Apache-2.0
#include "daemon/record_feed.h"

#include <algorithm>

#include "daemon/json_text.h"
#include "record/json/json_object.h"

namespace navcal::daemon {
RecordFeed::RecordFeed(const config::Settings& settings, StatusServer& server) : server_(server) {
  for (const auto& port : settings.ports) devices_.push_back(port.name);
  // The estimate's virtual device follows those of the ports (navigation_device).
  devices_.emplace_back(pipeline::kNavigationDevice);
}

void RecordFeed::publish(const record::MessageHead& head, std::int64_t utc_ns, const record::AppendJson& append) {
  const auto found = std::find(devices_.begin(), devices_.end(), head.device);
  RecordKey key{head.topic, std::nullopt, head.repeats};
  if (found != devices_.end()) key.port = static_cast<std::uint16_t>(found - devices_.begin());
  if (!server_.watched(key)) return;
  line_ = R"({"class":"RECORD","topic":")";
  for (const record::Topic& known : record::json_topics()) {
    if (known.id == key.topic) line_ += known.name;
  }
  line_ += R"(","device":)";
  if (head.device.empty()) {
    line_ += "null";
  } else {
    append_quoted(line_, head.device);
  }
  line_ += ",\"time\":";
  utc_ns < pipeline::kFirstUtc_ns ? void(line_ += "null") : record::append_seconds(line_, utc_ns);
  line_ += ",\"message\":";
  record::append_payload(line_, append);
  line_ += "}\r\n";
  server_.publish(key, line_);
}

}  // namespace navcal::daemon
