// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Messages of Foxglove's WebSocket protocol v1 (https://github.com/foxglove/ws-protocol, docs/spec.md), as far as
/// a server needs them that only shows. The subprotocol foxglove.sdk.v1 has the same messages.
namespace navcal::web::foxglove {

enum class StatusLevel { info = 0, warning = 1, error = 2 };

[[nodiscard]] std::string server_info(std::string_view name, std::string_view version, std::string_view session);
/// `id`: a newer status with the same id replaces the older one, in programs that know ids; empty: none.
[[nodiscard]] std::string status(StatusLevel level, std::string_view message, std::string_view id = {});
/// `channels` are JSON objects.
[[nodiscard]] std::string advertise(const std::vector<std::string_view>& channels);
[[nodiscard]] std::string unadvertise(const std::vector<std::uint32_t>& channels);
/// A channel for advertise(): of JSON messages with a JSON schema, or of messages of ROS in CDR with their
/// definition.
[[nodiscard]] std::string channel(std::uint32_t id, std::string_view topic, std::string_view schema_name,
                                  std::string_view schema, bool is_ros = false);
/// Binary: a message for one subscription. `time_ns` is UTC.
[[nodiscard]] std::string message_data(std::uint32_t subscription, std::uint64_t time_ns,
                                       std::string_view payload);
/// Binary: the server's time, UTC.
[[nodiscard]] std::string time(std::uint64_t time_ns);

struct Subscription {
  std::uint32_t id = 0;
  std::uint32_t channel = 0;
};

/// A text message from a client. What is wrong with it stands in `problem`; its sound parts are kept.
struct ClientMessage {
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;
  std::string problem;       ///< the first one, in words; empty: none
  std::size_t problems = 0;  ///< how many there are
};
void note_problem(ClientMessage& message, std::string problem);
[[nodiscard]] ClientMessage read_client_message(std::string_view text);

}  // namespace navcal::web::foxglove
