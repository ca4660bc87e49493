// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <optional>

#include "config/settings.h"

namespace navcal::daemon {

/// The status socket. Throws StartError; a port that is taken is explained.
[[nodiscard]] boost::asio::ip::tcp::acceptor listen_status(const boost::asio::any_io_executor& executor,
                                                           const config::StatusSettings& settings);

/// The control socket, with its permissions from the first moment on. What a dead daemon left behind is replaced;
/// a living one is not disturbed. Throws StartError.
[[nodiscard]] boost::asio::local::stream_protocol::acceptor listen_control(
    const boost::asio::any_io_executor& executor, const config::ControlSettings& settings);

/// Listening sockets handed over by systemd (sd_listen_fds(3)), told apart by their kind: TCP is the status
/// socket, Unix the control socket.
struct ActivatedSockets {
  std::optional<boost::asio::ip::tcp::acceptor> status;
  std::optional<boost::asio::local::stream_protocol::acceptor> control;
};

/// Throws StartError for a socket that is neither, or a second of its kind.
[[nodiscard]] ActivatedSockets take_activated_sockets(const boost::asio::any_io_executor& executor);

}  // namespace navcal::daemon
