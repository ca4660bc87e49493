// SPDX-License-Identifier: Apache-2.0
#include "daemon/record_feed.h"

#include <algorithm>
#include <utility>

#include "daemon/json_text.h"
#include "record/json/battery_json.h"
#include "record/json/command_json.h"
#include "record/json/event_json.h"
#include "record/json/json_object.h"
#include "record/json/mapping_json.h"
#include "record/json/navigation_json.h"
#include "record/json/sample_json.h"
#include "record/log/log_topics.h"

namespace navcal::daemon {
namespace topic = record::topic;

RecordFeed::RecordFeed(const config::Settings& settings, StatusServer& server) : server_(server) {
  for (const auto& port : settings.ports) devices_.push_back(port.name);
  // The estimate's virtual device follows those of the ports (navigation_device).
  devices_.emplace_back(pipeline::kNavigationDevice);
}

std::optional<std::uint16_t> RecordFeed::port_named(std::string_view name) const {
  const auto found = std::find(devices_.begin(), devices_.end(), name);
  if (found == devices_.end()) return std::nullopt;
  return static_cast<std::uint16_t>(found - devices_.begin());
}

template <class Append>
void RecordFeed::publish(const RecordKey& key, std::string_view device, std::int64_t utc_ns, Append&& append) {
  line_ = R"({"class":"RECORD","topic":")";
  for (const record::Topic& known : record::json_topics()) {
    if (known.id == key.topic) line_ += known.name;
  }
  line_ += R"(","device":)";
  if (device.empty()) {
    line_ += "null";
  } else {
    append_quoted(line_, device);
  }
  line_ += ",\"time\":";
  utc_ns < pipeline::kFirstUtc_ns ? void(line_ += "null") : record::append_seconds(line_, utc_ns);
  line_ += ",\"message\":";
  record::append_payload(line_, std::forward<Append>(append));
  line_ += "}\r\n";
  server_.publish(key, line_);
}

void RecordFeed::sample(const instruments::Sample& sample) {
  const RecordKey key{record::head_of(sample).topic, sample.port, true};
  if (key.topic == 0 || !server_.watched(key)) return;
  const std::string& device = devices_[sample.port];
  publish(key, device, sample.stamp.validity_utc_ns,
          [&](std::string& out) { record::append_json(out, sample, device); });
}

void RecordFeed::navigation(const pipeline::NavigationSample& sample) {
  const RecordKey key{topic::kNav, static_cast<std::uint16_t>(devices_.size() - 1), true};
  if (!server_.watched(key)) return;
  publish(key, pipeline::kNavigationDevice, sample.stamp.validity_utc_ns,
          [&](std::string& out) { record::append_json(out, sample); });
}

void RecordFeed::battery(const pipeline::BatterySample& sample) {
  const RecordKey key{topic::kBattery, sample.port, true};
  if (!server_.watched(key)) return;
  const std::string& device = devices_[sample.port];
  publish(key, device, sample.stamp.validity_utc_ns,
          [&](std::string& out) { record::append_json(out, sample, device); });
}

void RecordFeed::mapping(std::int64_t now_ns, const pipeline::UtcMapping& mapping) {
  mapping_ = mapping;
  const RecordKey key{topic::kTime, std::nullopt, false};
  if (!server_.watched(key)) return;
  publish(key, {}, mapping_.to_utc(now_ns), [&](std::string& out) { record::append_json(out, now_ns, mapping_); });
}

void RecordFeed::event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                       std::string_view port, std::string_view message) {
  const RecordKey key{topic::kEvent, port_named(port), false};
  if (!server_.watched(key)) return;
  publish(key, port, mapping_.to_utc(now_ns), [&](std::string& out) {
    record::append_event_json(out, mapping_, now_ns, severity, name, port, message);
  });
}

void RecordFeed::health(std::int64_t now_ns, std::string_view json) {
  const RecordKey key{topic::kHealth, std::nullopt, false};
  if (!server_.watched(key)) return;
  publish(key, {}, mapping_.to_utc(now_ns), [&](std::string& out) { out += json; });
}

void RecordFeed::calib(std::int64_t now_ns, std::string_view json) {
  const RecordKey key{topic::kCalib, std::nullopt, false};
  if (!server_.watched(key)) return;
  publish(key, {}, mapping_.to_utc(now_ns), [&](std::string& out) { out += json; });
}

void RecordFeed::command(std::int64_t now_ns, std::string_view device, const control::OrderRecord& record) {
  const RecordKey key{topic::kCommand, port_named(device), false};
  if (!server_.watched(key)) return;
  const std::int64_t validity_ns = record::head_of(record, now_ns).validity_ns;
  publish(key, device, mapping_.to_utc(validity_ns),
          [&](std::string& out) { record::append_json(out, mapping_, now_ns, device, record); });
}

}  // namespace navcal::daemon
