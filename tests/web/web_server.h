// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "web/access.h"
#include "web/listener.h"
#include "web/server.h"
#include "web/site.h"

namespace navcal::web::test {

/// Runs `work` in the thread that runs the context, and waits for its result.
template <class Work>
auto run_in_loop(boost::asio::io_context& context, Work work) {
  std::packaged_task<decltype(work())()> task(std::move(work));
  auto result = task.get_future();
  boost::asio::post(context, [&task] { task(); });
  return result.get();
}

/// A server on a free port of the loopback address, its loop in a thread of its own.
class WebServer {
 public:
  explicit WebServer(ServerLimits limits = {}, std::string token = {})
      : limits_(limits), access_(std::move(token)) {}
  ~WebServer() {
    boost::asio::post(context_, [this] {
      if (server_) server_->stop();
      context_.stop();
    });
    if (thread_.joinable()) thread_.join();
  }
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Call it after the site has been filled.
  void start() {
    server_ = std::make_shared<Server>(listen(context_.get_executor(), "127.0.0.1", 0), site, access_, limits_);
    port_ = server_->port();
    server_->start();
    thread_ = std::thread([this] {
      const auto work = boost::asio::make_work_guard(context_);
      context_.run();
    });
  }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const Access& access() const { return access_; }
  [[nodiscard]] boost::asio::any_io_executor executor() { return context_.get_executor(); }
  /// Runs `work` in the thread of the loop and waits for its result.
  template <class Work>
  auto in_loop(Work work) {
    return run_in_loop(context_, std::move(work));
  }
  [[nodiscard]] ServerCounters counters() {
    return in_loop([this] { return server_->counters(); });
  }

  Site site;

 private:
  boost::asio::io_context context_;
  ServerLimits limits_;
  Access access_;
  std::shared_ptr<Server> server_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

/// A client that sends any bytes.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : socket_(context_) {
    socket_.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  }
  void send(std::string_view bytes) {
    boost::system::error_code closed;
    boost::asio::write(socket_, boost::asio::buffer(bytes), closed);
  }
  /// Everything until the server closes the connection, or "(still open)" behind it after the limit.
  [[nodiscard]] std::string read_to_end(std::chrono::milliseconds limit = std::chrono::minutes(2)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    std::string all;
    for (;;) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      pollfd readable{socket_.native_handle(), POLLIN, 0};
      if (left.count() <= 0 || ::poll(&readable, 1, static_cast<int>(left.count())) <= 0)
        return all + "(still open)";
      char chunk[4096];
      const ssize_t n = ::recv(socket_.native_handle(), chunk, sizeof chunk, 0);
      if (n <= 0) return all;
      all.append(chunk, static_cast<std::size_t>(n));
    }
  }
  /// One request, and the answer up to the end of the connection.
  [[nodiscard]] std::string get(const std::string& target, const std::string& headers = "Host: localhost\r\n") {
    send("GET " + target + " HTTP/1.1\r\n" + headers + "Connection: close\r\n\r\n");
    return read_to_end();
  }

 private:
  boost::asio::io_context context_;
  boost::asio::ip::tcp::socket socket_;
};

/// A WebSocket client with blocking calls.
class WebSocketClient {
 public:
  WebSocketClient(std::uint16_t port, const std::string& target, const std::string& subprotocols = {},
                  const std::string& origin = {}, int receive_buffer_bytes = 0,
                  const std::string& host = "localhost")
      : stream_(context_) {
    auto& socket = stream_.next_layer();
    socket.open(boost::asio::ip::tcp::v4());
    if (receive_buffer_bytes > 0)
      socket.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer_bytes));
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), port});
    stream_.set_option(
        boost::beast::websocket::stream_base::decorator([&](boost::beast::websocket::request_type& request) {
          namespace http = boost::beast::http;
          if (!subprotocols.empty()) request.set(http::field::sec_websocket_protocol, subprotocols);
          if (!origin.empty()) request.set(http::field::origin, origin);
        }));
    boost::beast::websocket::response_type response;
    // Boost 1.74 leaves the response out where it declines, unless the handshake is asynchronous.
    stream_.async_handshake(response, host + ":" + std::to_string(port), target,
                            [](const boost::system::error_code&) {});
    context_.run();
    status_ = response.result_int();
    subprotocol_ = std::string(response[boost::beast::http::field::sec_websocket_protocol]);
  }
  /// 101 when the server took the client.
  [[nodiscard]] unsigned status() const { return status_; }
  [[nodiscard]] const std::string& subprotocol() const { return subprotocol_; }
  void send(std::string_view text, bool binary = false) {
    stream_.binary(binary);
    boost::system::error_code closed;
    stream_.write(boost::asio::buffer(text), closed);
  }
  /// The next message; "(closed)" when there is none.
  [[nodiscard]] std::string read() {
    boost::beast::flat_buffer buffer;
    boost::system::error_code closed;
    stream_.read(buffer, closed);
    if (closed) return "(closed)";
    return {static_cast<const char*>(buffer.data().data()), buffer.size()};
  }
  [[nodiscard]] std::string close_reason() const { return stream_.reason().reason.c_str(); }
  void close() {
    boost::system::error_code closed;
    stream_.close(boost::beast::websocket::close_code::normal, closed);
  }
  [[nodiscard]] auto& socket() { return stream_.next_layer(); }

 private:
  boost::asio::io_context context_;
  boost::beast::websocket::stream<boost::asio::ip::tcp::socket> stream_;
  unsigned status_ = 0;
  std::string subprotocol_;
};

}  // namespace navcal::web::test
