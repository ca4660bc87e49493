// SPDX-License-Identifier: Apache-2.0
#include "daemon/remote_line.h"

#include <fmt/format.h>

#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <utility>
#include <vector>

#include "config/network_address.h"
#include "daemon/start_error.h"
#include "ports/no_throw.h"
#include "ports/port.h"

namespace navcal::daemon {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Bytes that wait for a slow peer at most; a frame beyond it is dropped, as a radio drops it.
constexpr std::size_t kWaitingBytes = 4096;

class SerialLine : public RemoteLine, private ports::PortListener {
 public:
  SerialLine(const asio::any_io_executor& executor, const config::RemoteSettings& settings, Events events)
      : events_(std::move(events)), port_(executor, port_settings(settings), listener()) {}

  void start() override { port_.start(); }
  void stop() override { port_.stop(); }
  void send(protocols::Bytes frame) override { port_.send(frame); }

 private:
  static config::PortSettings port_settings(const config::RemoteSettings& settings) {
    config::PortSettings port;
    port.name = "remote";
    port.path = settings.path;
    port.baud = settings.baud;
    return port;
  }
  ports::PortListener& listener() { return *this; }
  void on_opened(std::int64_t now_ns, const ports::OpenPort& port) override {
    events_.on_state(now_ns, true, port.path);
  }
  void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) override { events_.on_bytes(arrival_ns, bytes); }
  void on_sent(std::int64_t, protocols::Bytes) override {}
  void on_lost(std::int64_t now_ns, std::string_view reason) override { events_.on_state(now_ns, false, reason); }

  Events events_;
  ports::Port port_;
};

/// One connection at a time: a new one takes the place of the one before, whose end may not have been noticed.
class TcpLine : public RemoteLine {
 public:
  TcpLine(const asio::any_io_executor& executor, const config::RemoteSettings& settings, Events events)
      : state_(std::make_shared<State>(executor, std::move(events))) {
    const auto address = config::socket_address(settings.listen);
    if (!address) throw StartError("remote.listen: no address");
    boost::system::error_code error;
    const std::string literal = address->address == "localhost" ? "127.0.0.1" : address->address;
    const tcp::endpoint endpoint(asio::ip::make_address(literal), address->port);
    state_->acceptor.open(endpoint.protocol());
    state_->acceptor.set_option(asio::socket_base::reuse_address(true));
    state_->acceptor.bind(endpoint, error);
    if (!error) state_->acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw StartError(fmt::format("remote.listen {}: {}", settings.listen, error.message()));
  }
  ~TcpLine() override { TcpLine::stop(); }
  TcpLine(const TcpLine&) = delete;
  TcpLine& operator=(const TcpLine&) = delete;

  void start() override { asio::co_spawn(state_->acceptor.get_executor(), State::accept(state_), asio::detached); }
  void stop() override {
    state_->is_stopped = true;
    boost::system::error_code ignored;
    state_->acceptor.close(ignored);
    state_->drop();
  }
  void send(protocols::Bytes frame) override {
    State& state = *state_;
    if (!state.connection || state.waiting.size() + frame.size() > kWaitingBytes) return;
    state.waiting.insert(state.waiting.end(), frame.begin(), frame.end());
    if (!std::exchange(state.is_writing, true))
      asio::co_spawn(state.acceptor.get_executor(), State::write(state_, state.connection), asio::detached);
  }

 private:
  struct State {
    State(const asio::any_io_executor& executor, Events line_events)
        : acceptor(executor), events(std::move(line_events)) {}

    static asio::awaitable<void> accept(std::shared_ptr<State> self);
    static asio::awaitable<void> read(std::shared_ptr<State> self, std::shared_ptr<tcp::socket> socket);
    static asio::awaitable<void> write(std::shared_ptr<State> self, std::shared_ptr<tcp::socket> socket);
    void drop() {
      boost::system::error_code ignored;
      if (connection) connection->close(ignored);
      connection.reset();
      waiting.clear();
      is_writing = false;
    }

    tcp::acceptor acceptor;
    Events events;
    std::shared_ptr<tcp::socket> connection;
    std::vector<std::uint8_t> waiting;
    bool is_writing = false;
    bool is_stopped = false;
  };
  std::shared_ptr<State> state_;
};

asio::awaitable<void> TcpLine::State::accept(std::shared_ptr<State> self) {
  while (!self->is_stopped) {
    auto socket = std::make_shared<tcp::socket>(self->acceptor.get_executor());
    const auto [error] = co_await self->acceptor.async_accept(*socket, ports::kNoThrow);
    if (self->is_stopped) co_return;
    if (error) {
      // For instance no descriptors left: a moment later there may be some.
      asio::steady_timer pause(self->acceptor.get_executor(), std::chrono::milliseconds(100));
      co_await pause.async_wait(ports::kNoThrow);
      continue;
    }
    boost::system::error_code ignored;
    socket->set_option(tcp::no_delay(true), ignored);
    const auto peer = socket->remote_endpoint(ignored);
    self->drop();
    self->connection = socket;
    self->events.on_state(ports::monotonic_ns(), true, "connection from " + peer.address().to_string());
    asio::co_spawn(self->acceptor.get_executor(), read(self, socket), asio::detached);
  }
}

asio::awaitable<void> TcpLine::State::read(std::shared_ptr<State> self, std::shared_ptr<tcp::socket> socket) {
  std::array<std::uint8_t, 1024> chunk{};
  for (;;) {
    const auto [error, n] = co_await socket->async_read_some(asio::buffer(chunk), ports::kNoThrow);
    if (self->is_stopped || self->connection != socket) co_return;
    if (error) break;
    self->events.on_bytes(ports::monotonic_ns(), {chunk.data(), n});
  }
  self->drop();
  self->events.on_state(ports::monotonic_ns(), false, "the connection ended");
}

asio::awaitable<void> TcpLine::State::write(std::shared_ptr<State> self, std::shared_ptr<tcp::socket> socket) {
  while (self->connection == socket && !self->waiting.empty()) {
    const std::vector<std::uint8_t> bytes = std::exchange(self->waiting, {});
    const auto [error, n] = co_await asio::async_write(*socket, asio::buffer(bytes), ports::kNoThrow);
    // After an error the reading side finds out what became of the connection.
    if (error) break;
  }
  if (self->connection == socket) self->is_writing = false;
}

}  // namespace

std::unique_ptr<RemoteLine> make_remote_line(const asio::any_io_executor& executor,
                                             const config::RemoteSettings& settings, RemoteLine::Events events) {
  if (!settings.path.empty()) return std::make_unique<SerialLine>(executor, settings, std::move(events));
  return std::make_unique<TcpLine>(executor, settings, std::move(events));
}

}  // namespace navcal::daemon
