// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "web/peer.h"

namespace navcal::web::foxglove {

/// What a viewer is sent, in place of a WebSocket. When it is full, messages are dropped.
class FakeLink final : public PeerLink {
 public:
  bool send(Payload payload) override {
    if (is_full) return false;
    sent.push_back(std::move(payload));
    return true;
  }
  void close(std::string_view) override { is_closed = true; }
  [[nodiscard]] std::size_t queued_bytes() const override { return 0; }

  /// The text messages with this op; all are forgotten.
  [[nodiscard]] std::vector<nlohmann::json> take(const std::string& op) {
    std::vector<nlohmann::json> found;
    for (const Payload& payload : sent) {
      if (payload.binary) continue;
      auto json = nlohmann::json::parse(*payload.bytes);
      if (json["op"] == op) found.push_back(std::move(json));
    }
    sent.clear();
    return found;
  }
  struct Message {
    std::uint32_t subscription = 0;
    std::uint64_t time_ns = 0;
    std::string payload;
  };
  [[nodiscard]] std::vector<Message> messages() const {
    std::vector<Message> found;
    for (const Payload& payload : sent) {
      if (!payload.binary || (*payload.bytes)[0] != 1) continue;
      found.push_back({static_cast<std::uint32_t>(number(*payload.bytes, 1, 4)), number(*payload.bytes, 5, 8),
                       payload.bytes->substr(13)});
    }
    return found;
  }
  [[nodiscard]] std::vector<std::uint64_t> times() const {
    std::vector<std::uint64_t> found;
    for (const Payload& payload : sent) {
      if (payload.binary && (*payload.bytes)[0] == 2) found.push_back(number(*payload.bytes, 1, 8));
    }
    return found;
  }
  [[nodiscard]] static std::uint64_t number(const std::string& bytes, std::size_t begin, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(begin + i));
    return value;
  }

  std::vector<Payload> sent;
  bool is_full = false;
  bool is_closed = false;
};

}  // namespace navcal::web::foxglove
