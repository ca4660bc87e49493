// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <string>

namespace navcal::web {

/// The listening socket: the one that systemd handed over, otherwise a new one. Throws std::runtime_error, which
/// says what to do, when there is none.
[[nodiscard]] boost::asio::ip::tcp::acceptor listen(const boost::asio::any_io_executor& executor,
                                                    const std::string& address, std::uint16_t port);

}  // namespace navcal::web
