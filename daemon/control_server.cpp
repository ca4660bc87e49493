// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_server.h"

#include <spdlog/spdlog.h>

#include <array>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include "daemon/line_reader.h"
#include "ports/no_throw.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

constexpr std::size_t kMaxClients = 16;
constexpr auto kAcceptPause = std::chrono::milliseconds(500);

}  // namespace

ControlServer::ControlServer(asio::local::stream_protocol::acceptor acceptor, std::filesystem::path own_path,
                             Handler handler)
    : acceptor_(std::move(acceptor)), own_path_(std::move(own_path)), handler_(std::move(handler)) {}

ControlServer::~ControlServer() {
  std::error_code ignored;
  if (!own_path_.empty()) std::filesystem::remove(own_path_, ignored);
}

void ControlServer::start() { asio::co_spawn(acceptor_.get_executor(), accept_clients(), asio::detached); }

void ControlServer::stop() {
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  for (const auto& client : clients_) client->close(ignored);
}

asio::awaitable<void> ControlServer::accept_clients() {
  while (acceptor_.is_open()) {
    auto [error, accepted] = co_await acceptor_.async_accept(ports::kNoThrow);
    if (!acceptor_.is_open()) co_return;
    if (error) {
      spdlog::warn("control socket: cannot accept: {}", error.message());
      asio::steady_timer pause(acceptor_.get_executor(), kAcceptPause);
      co_await pause.async_wait(ports::kNoThrow);
      continue;
    }
    // More than these are not people at work: the connection is closed at once.
    if (clients_.size() >= kMaxClients) continue;
    auto socket = std::make_shared<Socket>(std::move(accepted));
    clients_.insert(socket);
    asio::co_spawn(acceptor_.get_executor(), serve(socket), [this, socket](const std::exception_ptr& failure) {
      if (failure) spdlog::warn("control socket: a client was dropped after an internal error");
      clients_.erase(socket);
    });
  }
}

asio::awaitable<void> ControlServer::serve(std::shared_ptr<Socket> socket) {
  std::array<char, 1024> chunk{};
  LineReader lines(kMaxControlLength);
  for (;;) {
    const auto [error, n] = co_await socket->async_read_some(asio::buffer(chunk), ports::kNoThrow);
    if (error) co_return;
    std::string answers;
    const bool accepted = lines.feed({chunk.data(), n}, [&](std::string_view line) { answers += answer(line); });
    if (!accepted) answers += control_error("line too long");
    const auto [write_error, written] =
        co_await asio::async_write(*socket, asio::buffer(answers), ports::kNoThrow);
    if (write_error || !accepted) co_return;
  }
}

std::string ControlServer::answer(std::string_view line) const {
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) return control_error(*error);
  return handler_(std::get<ControlRequest>(parsed));
}

}  // namespace navcal::daemon
