// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include "config/settings.h"

namespace navcal::daemon {

/// The status socket. Throws StartError; a port that is taken is explained.
[[nodiscard]] boost::asio::ip::tcp::acceptor listen_status(const boost::asio::any_io_executor& executor,
                                                           const config::StatusSettings& settings);

/// The control socket, with its permissions from the first moment on. What a dead daemon left behind is replaced;
/// a living one is not disturbed. Throws StartError.
[[nodiscard]] boost::asio::local::stream_protocol::acceptor listen_control(
    const boost::asio::any_io_executor& executor, const config::ControlSettings& settings);

}  // namespace navcal::daemon
