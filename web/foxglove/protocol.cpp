// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/protocol.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "protocols/wire_fields.h"
#include "record/json/json_members.h"

namespace navcal::web::foxglove {
namespace {

using record::json_text;

constexpr std::uint8_t kMessageData = 1, kTime = 2;

/// Ids have 32 bits, because a message's head has room for so many.
std::optional<std::uint32_t> id_of(const nlohmann::json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto id = value.get<std::uint64_t>();
  if (id > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(id);
}

std::optional<std::uint32_t> id_of(const nlohmann::json& object, const char* name) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(name);
  return found == object.end() ? std::nullopt : id_of(*found);
}

/// Null when the member is absent or no list.
const nlohmann::json* list_in(ClientMessage& message, const nlohmann::json& json, const std::string& name) {
  const auto found = json.find(name);
  if (found != json.end() && found->is_array()) return &*found;
  note_problem(message, name + " must be a list");
  return nullptr;
}

void read_subscribe(ClientMessage& message, const nlohmann::json& json) {
  const auto* list = list_in(message, json, "subscriptions");
  if (list == nullptr) return;
  for (const auto& entry : *list) {
    const auto id = id_of(entry, "id");
    const auto channel = id_of(entry, "channelId");
    if (id && channel) {
      message.subscribe.push_back({*id, *channel});
    } else {
      note_problem(message, "a subscription needs id and channelId, both numbers of 32 bits");
    }
  }
}

void read_unsubscribe(ClientMessage& message, const nlohmann::json& json) {
  const auto* list = list_in(message, json, "subscriptionIds");
  if (list == nullptr) return;
  for (const auto& entry : *list) {
    if (const auto id = id_of(entry)) {
      message.unsubscribe.push_back(*id);
    } else {
      note_problem(message, "a subscription id is a number of 32 bits");
    }
  }
}

}  // namespace

std::string server_info(std::string_view name, std::string_view version, std::string_view session) {
  return json_text({{"op", "serverInfo"},
                    {"name", name},
                    {"capabilities", {"time"}},
                    {"metadata", {{"version", version}}},
                    {"sessionId", session}});
}

std::string status(StatusLevel level, std::string_view message, std::string_view id) {
  nlohmann::ordered_json json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}};
  if (!id.empty()) json["id"] = id;
  return json_text(json);
}

std::string advertise(const std::vector<std::string_view>& channels) {
  std::string text = R"({"op":"advertise","channels":[)";
  for (const std::string_view one : channels) {
    if (text.back() == '}') text += ',';
    text += one;
  }
  return text + "]}";
}

std::string unadvertise(const std::vector<std::uint32_t>& channels) {
  return json_text({{"op", "unadvertise"}, {"channelIds", channels}});
}

std::string channel(std::uint32_t id, std::string_view topic, std::string_view schema_name,
                    std::string_view schema, bool is_ros) {
  return json_text({{"id", id},
                    {"topic", topic},
                    {"encoding", is_ros ? "cdr" : "json"},
                    {"schemaName", schema_name},
                    {"schema", schema},
                    {"schemaEncoding", is_ros ? "ros2msg" : "jsonschema"}});
}

std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view payload) {
  const auto head = protocols::packed_le(kMessageData, subscription, time_ns);
  return std::string(head.begin(), head.end()).append(payload);
}

std::string time(std::uint64_t time_ns) {
  const auto bytes = protocols::packed_le(kTime, time_ns);
  return {bytes.begin(), bytes.end()};
}

void note_problem(ClientMessage& message, std::string problem) {
  if (++message.problems == 1) message.problem = std::move(problem);
}

ClientMessage read_client_message(std::string_view text) {
  ClientMessage message;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("op") || !json["op"].is_string()) {
    note_problem(message, "a message is a JSON object with an op");
    return message;
  }
  const auto& op = json["op"].get_ref<const std::string&>();
  if (op == "subscribe") {
    read_subscribe(message, json);
  } else if (op == "unsubscribe") {
    read_unsubscribe(message, json);
  } else {
    constexpr std::size_t kShown = 40;
    note_problem(message,
                 "this server only shows: it takes subscribe and unsubscribe, not " + op.substr(0, kShown));
  }
  return message;
}

}  // namespace navcal::web::foxglove
