// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "web/record.h"

namespace navcal::web {

/// Where a record goes in MQTT.
struct MqttPlace {
  std::string topic;
  bool is_event =
      false;  ///< is sent at once and not kept by the broker; others are states, of which the newest counts
};

/// PREFIX/TOPIC or PREFIX/TOPIC/DEVICE. Characters that mean something to MQTT become underscores. Nullopt for
/// what is no topic of the log.
[[nodiscard]] std::optional<MqttPlace> mqtt_place(std::string_view prefix, const Record& record);

/// Why `prefix` cannot begin a topic; empty when it can.
[[nodiscard]] std::string problem_of_prefix(const std::string& prefix);

struct MqttBroker {
  std::string host;
  std::string port = "1883";
};
/// HOST, HOST:PORT or [ADDRESS]:PORT. Nullopt when it is none of them.
[[nodiscard]] std::optional<MqttBroker> mqtt_broker(std::string_view text);

}  // namespace navcal::web
