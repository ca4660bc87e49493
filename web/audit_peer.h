// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>

#include "web/peer.h"

namespace navcal::web {

/// WebSocket clients at `/audit` that send a log and get the page of `navcal audit` (docs/web.md). The first
/// message is
/// `{"name":"dive.BIN","bytes":123}`, the log follows in binary messages, each of which is answered by
/// `{"received":123}`. Then come `{"progress":"..."}`, and the page as a binary message, or
/// `{"ok":false,"error":"..."}`. Clients of this machine alone are served, one at a time. When one goes, its audit
/// ends and its files are removed.
[[nodiscard]] WebSocketEndpoint audit_endpoint(const boost::asio::any_io_executor& executor);

}  // namespace navcal::web
