// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <filesystem>

#include "web/access.h"
#include "web/peer.h"

namespace navcal::web {

/// WebSocket clients at `path` that speak to navcald's control socket (docs/web.md). The first message is
/// `{"token":"..."}`. Each message after it is one request, and each answer one message. Every client has a
/// connection of its own to navcald: when its WebSocket ends, so does that connection, and with it a lease of the
/// motor.
[[nodiscard]] WebSocketEndpoint control_endpoint(const boost::asio::any_io_executor& executor, std::string path,
                                                 std::filesystem::path control_socket, const Access& access);

}  // namespace navcal::web
