// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "web/hub.h"
#include "web/peer.h"

namespace navcal::web::foxglove {

/// Counts messages that a client missed because it did not read, and words the report. UTC, ns.
class DropCount {
 public:
  void dropped(std::int64_t now_ns);
  /// Words for what was dropped since the last report; nullopt when nothing was, or when the last report is
  /// younger than a second: a client that is slow all the time must not get more reports than messages.
  [[nodiscard]] std::optional<std::string> report(std::int64_t now_ns);
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  std::uint64_t total_ = 0, since_report_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::optional<std::int64_t> reported_ns_;
};

/// UTC, ns since 1970: tells when messages were dropped, and stands for times of validity until one is known.
using Clock = std::function<std::int64_t()>;
[[nodiscard]] std::int64_t system_time_ns();

/// WebSocket clients at `/` that offer foxglove.websocket.v1 or foxglove.sdk.v1: Foxglove, Lichtblick and others
/// (docs/foxglove.md). Pages of any site may connect, because they can only look. `hub` must outlive the server.
[[nodiscard]] WebSocketEndpoint endpoint(Hub& hub, std::string version, Clock clock = system_time_ns);

}  // namespace navcal::web::foxglove
