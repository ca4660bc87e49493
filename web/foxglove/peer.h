// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "web/hub.h"
#include "web/peer.h"

namespace navcal::web::foxglove {

/// UTC, ns since 1970: tells when messages were dropped, and stands for times of validity until one is known.
using Clock = std::function<std::int64_t()>;
[[nodiscard]] std::int64_t system_time_ns();

/// WebSocket clients at `/` that offer foxglove.websocket.v1 or foxglove.sdk.v1: Foxglove, Lichtblick and others
/// (docs/foxglove.md). Pages of any site may connect, because they can only look. `hub` must outlive the server.
[[nodiscard]] WebSocketEndpoint endpoint(Hub& hub, std::string version, Clock clock = system_time_ns);

}  // namespace navcal::web::foxglove
