// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt_topics.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

/// MQTT takes topics of up to 64 KiB; nothing here is nearly as long.
constexpr std::size_t kMaxTopic = 200;

std::string mqtt_level(std::string_view name) {
  std::string level(name.substr(0, kMaxTopic));
  std::replace_if(
      level.begin(), level.end(),
      [](char c) { return c == '#' || c == '+' || c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
      '_');
  return level;
}

/// navcald cuts a long report into lines: each is a topic of its own, so that none replaces another.
std::string suffix_of_part(std::string_view message) {
  if (message.find("\"parts\":") == std::string_view::npos) return {};
  const auto report = nlohmann::json::parse(message, nullptr, false);
  const auto part = report.is_object() ? number_in(report, "part") : std::nullopt;
  return part && *part >= 1 && *part < 1000 ? "/" + std::to_string(static_cast<int>(*part)) : std::string();
}

}  // namespace

std::optional<MqttPlace> mqtt_place(std::string_view prefix, const Record& record) {
  if (record.topic.size() < 2 || record.topic.front() != '/') return std::nullopt;
  MqttPlace place;
  std::string name = mqtt_level(record.topic.substr(1));
  if (name == "calib" && record.message.find(R"("class":"CALIBRATION")") != std::string_view::npos) {
    name = "calibration";
    place.is_event = true;
  }
  place.is_event = place.is_event || name == "event" || name == "command";
  place.topic = std::string(prefix) + '/' + name;
  // There is one estimator: its name would only lengthen the topic.
  if (name != "nav" && !place.is_event && !record.device.empty()) place.topic += '/' + mqtt_level(record.device);
  if (name == "health" || name == "calib") place.topic += suffix_of_part(record.message);
  return place;
}

std::string problem_of_prefix(const std::string& prefix) {
  if (prefix.empty() || prefix.size() > kMaxTopic) return "wants 1 to 200 characters";
  if (prefix.find_first_of("#+") != std::string::npos) return "# and + are no part of a topic";
  if (prefix.front() == '$' || prefix.front() == '/' || prefix.back() == '/')
    return "it begins with neither $ nor /, and does not end with /";
  const bool has_control = std::any_of(prefix.begin(), prefix.end(), [](unsigned char c) { return c < 0x20; });
  return has_control || !nlohmann::json::accept("\"" + prefix + "\"") ? "wants UTF-8 without control characters"
                                                                      : "";
}

std::optional<MqttBroker> mqtt_broker(std::string_view text) {
  MqttBroker broker;
  std::string_view port;
  if (text.starts_with('[')) {
    const auto end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    broker.host = text.substr(1, end - 1);
    port = text.substr(end + 1);
  } else {
    const auto colon = text.find(':');
    broker.host = text.substr(0, colon);
    port = colon == std::string_view::npos ? std::string_view() : text.substr(colon);
  }
  if (broker.host.empty()) return std::nullopt;
  if (port.empty()) return broker;
  const bool is_number = port.size() >= 2 && port.size() <= 6 && port.front() == ':' &&
                         port.find_first_not_of("0123456789", 1) == std::string_view::npos;
  if (!is_number) return std::nullopt;
  broker.port = port.substr(1);
  const int number = std::stoi(broker.port);
  return number >= 1 && number <= 65535 ? std::optional(broker) : std::nullopt;
}

}  // namespace navcal::web
