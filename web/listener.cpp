// SPDX-License-Identifier: Apache-2.0
#include "web/listener.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <stdexcept>

#include "base/service_manager.h"

namespace navcal::web {
namespace asio = boost::asio;

asio::ip::tcp::acceptor listen(const asio::any_io_executor& executor, const std::string& address,
                               std::uint16_t port) {
  const int count = base::take_handed_over();
  if (count > 1) throw std::runtime_error(fmt::format("socket activation: {} sockets, one is needed", count));
  if (count == 1) {
    const bool v4 = base::is_listening(base::kFirstHandedOver, AF_INET);
    if (!v4 && !base::is_listening(base::kFirstHandedOver, AF_INET6))
      throw std::runtime_error("socket activation: the socket is no listening TCP socket");
    return {executor, v4 ? asio::ip::tcp::v4() : asio::ip::tcp::v6(), base::kFirstHandedOver};
  }
  boost::system::error_code error;
  const auto parsed = asio::ip::make_address(address == "localhost" ? "127.0.0.1" : address, error);
  if (error) throw std::runtime_error(fmt::format("--address: \"{}\" is not an IP address", address));
  const asio::ip::tcp::endpoint endpoint(parsed, port);
  asio::ip::tcp::acceptor acceptor(executor);
  acceptor.open(endpoint.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    throw std::runtime_error(fmt::format("port {} at {} is taken; --port chooses another", port, address));
  if (error)
    throw std::runtime_error(fmt::format("cannot listen at {} port {}: {}", address, port, error.message()));
  return acceptor;
}

}  // namespace navcal::web
