// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <list>
#include <memory>

#include "web/access.h"
#include "web/site.h"

namespace navcal::web {

class WebSocketSession;

/// Bounds that keep one client from costing others anything.
struct ServerLimits {
  std::size_t connections = 256;  ///< a further one takes the place of the oldest that has not shown the token
  std::size_t header_bytes = 8 << 10;
  std::size_t body_bytes = 64 << 10;
  std::size_t message_bytes = 64 << 10;  ///< of a WebSocket message from a client
  std::size_t queue_bytes = 1 << 20;     ///< that wait for one WebSocket client
  /// For a whole request or answer, and between two requests on one connection.
  std::chrono::milliseconds request{15'000};
  /// A WebSocket client that takes nothing and says nothing for this long is gone.
  std::chrono::milliseconds silence{30'000};
};

struct ServerCounters {
  std::uint64_t connections = 0;
  std::uint64_t connections_refused = 0;  ///< closed because of the bound
  std::uint64_t requests = 0;
  std::uint64_t requests_refused = 0;  ///< answered with a status of 400 and above
  std::uint64_t requests_broken = 0;   ///< no HTTP, too large, or not complete in time
  std::uint64_t web_sockets = 0;
  std::uint64_t web_sockets_open = 0;
  std::uint64_t messages_sent = 0;
  std::uint64_t messages_dropped = 0;  ///< for clients that did not read
  std::uint64_t bytes_sent = 0;        ///< of WebSocket messages
};

/// HTTP and WebSocket on one port, one thread.
class Server : public std::enable_shared_from_this<Server> {
 public:
  Server(boost::asio::ip::tcp::acceptor acceptor, const Site& site, const Access& access,
         ServerLimits limits = {});
  void start();
  /// Closes everything; WebSocket clients are told "going away".
  void stop();

  [[nodiscard]] const ServerCounters& counters() const { return counters_; }
  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Client {
    boost::beast::tcp_stream stream;
    std::shared_ptr<WebSocketSession> session;  ///< has taken the stream; null: no WebSocket
  };
  boost::asio::awaitable<void> accept_clients();
  /// False when every place is an operator's.
  [[nodiscard]] bool make_room();
  boost::asio::awaitable<void> serve(std::shared_ptr<Client> client);
  boost::asio::awaitable<Response> answer(const Request& request);
  [[nodiscard]] const WebSocketEndpoint* endpoint_for(const Request& request, std::string& subprotocol,
                                                      std::optional<Response>& refusal) const;

  boost::asio::ip::tcp::acceptor acceptor_;
  const Site& site_;
  const Access& access_;
  ServerLimits limits_;
  ServerCounters counters_;
  std::list<std::shared_ptr<Client>> clients_;  ///< the oldest first
};

}  // namespace navcal::web
