// SPDX-License-Identifier: Apache-2.0
// Whatever a client of the web server sends, over a real socket: requests, WebSocket handshakes and frames. The
// server ends the connection, loses none of its own, and answers the next client.
#include <signal.h>
#include <sys/socket.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "tests/fuzz/target.h"
#include "web/access.h"
#include "web/listener.h"
#include "web/server.h"
#include "web/site.h"

namespace navcal::fuzz::web_server_target {

namespace asio = boost::asio;
using namespace navcal::web;

constexpr std::string_view kHandshake =
    "GET /echo HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

class Echo final : public Peer {
 public:
  explicit Echo(PeerLink& link) : link_(link) {}
  void on_open() override {}
  void on_text(std::string_view text) override { link_.send_text(std::string(text)); }
  void on_binary(std::string_view bytes) override {
    link_.send({std::make_shared<const std::string>(bytes), true});
  }

 private:
  PeerLink& link_;
};

/// One server for all inputs, as in the program.
struct Fixture {
  Site site;
  Access access;
  asio::io_context context;
  std::shared_ptr<Server> server;

  Fixture() {
    site.add("GET", "/hello", [](const Request&) -> asio::awaitable<Response> {
      co_return respond(boost::beast::http::status::ok, "text/plain", "hello");
    });
    WebSocketEndpoint echo;
    echo.path = "/echo";
    echo.make_peer = [](PeerLink& link, std::string_view) -> std::unique_ptr<Peer> {
      return std::make_unique<Echo>(link);
    };
    site.add(std::move(echo));
    server = std::make_shared<Server>(listen(context.get_executor(), "127.0.0.1", 0), site, access);
    server->start();
  }

  /// Sends `bytes` and ends; everything that the server answers until it closes the connection.
  std::string exchange(std::string_view bytes) {
    asio::ip::tcp::socket client(context);
    client.connect({asio::ip::make_address("127.0.0.1"), server->port()});
    boost::system::error_code closed;
    asio::write(client, asio::buffer(bytes), closed);
    client.shutdown(asio::socket_base::shutdown_send, closed);
    client.non_blocking(true);
    std::string answer;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (;;) {
      context.run_for(std::chrono::microseconds(200));
      char chunk[4096];
      const ssize_t n = ::recv(client.native_handle(), chunk, sizeof chunk, 0);
      if (n > 0) answer.append(chunk, static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EAGAIN)) return answer;
      if (std::chrono::steady_clock::now() > end) std::abort();  // the connection hangs
    }
  }
};

NAVCAL_FUZZ(web_server) {
  static auto& fixture = *new Fixture;
  if (size == 0) return 0;
  static_cast<void>(::signal(SIGPIPE, SIG_IGN));
  const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  fixture.exchange((data[0] & 1U) != 0 ? std::string(kHandshake).append(bytes) : std::string(bytes));
  if (!fixture.exchange("GET /hello HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n").ends_with("hello"))
    std::abort();
  if (fixture.server->counters().web_sockets_open > 0) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::web_server_target
