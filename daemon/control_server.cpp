// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_server.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include "base/line_reader.h"
#include "control/order_rate.h"
#include "ports/no_throw.h"
#include "ports/port.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

constexpr std::size_t kMaxClients = 16, kMostAtOnce = 128;
constexpr std::int64_t kJustCome_ns = 1'000'000'000;
constexpr auto kAcceptPause = std::chrono::milliseconds(500);
/// A connection that sends more lines than this is read only now and then.
constexpr double kMaxLines_Hz = 200;
constexpr std::int64_t kLook_ns = 20'000'000;
constexpr std::size_t kMaxAnswers = 32;
constexpr std::size_t kKeepers = 4;
constexpr auto kSlowDown = std::chrono::milliseconds(50);

asio::awaitable<std::string> do_work(std::function<std::string()> work) { co_return work(); }

}  // namespace

ControlServer::ControlServer(asio::local::stream_protocol::acceptor acceptor, std::filesystem::path own_path,
                             ControlOwner& owner)
    : acceptor_(std::move(acceptor)), own_path_(std::move(own_path)), owner_(owner),
      look_timer_(acceptor_.get_executor(), [this] { look_at_buffers(); }) {}

ControlServer::~ControlServer() {
  std::error_code ignored;
  if (!own_path_.empty()) std::filesystem::remove(own_path_, ignored);
}

void ControlServer::start() { asio::co_spawn(acceptor_.get_executor(), accept_clients(), asio::detached); }

void ControlServer::stop() {
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  look_timer_.stop();
  for (const auto& client : clients_) client->socket.close(ignored);
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
    if (clients_.size() >= kMaxClients) make_place();
    const std::int64_t now_ns = ports::monotonic_ns();
    auto client = std::make_shared<Client>(Client{std::move(accepted), ++last_client_, now_ns, now_ns});
    clients_.insert(client);
    look_timer_.arm(now_ns + kLook_ns);
    asio::co_spawn(acceptor_.get_executor(), serve(client), [this, client](const std::exception_ptr& failure) {
      drop_after(failure, *client);
      clients_.erase(client);
      owner_.control_client_gone(client->number, "its connection was closed");
    });
  }
}

void ControlServer::make_place() {
  const auto rank = [this](const auto& client) {
    return std::pair(!client->socket.is_open() || owner_.is_in_charge(client->number), client->used_ns);
  };
  const auto longest = std::min_element(clients_.begin(), clients_.end(),
                                        [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  if (longest == clients_.end() || rank(*longest).first) return;
  // One that has just come is about to ask: even of many that come at once none is closed before it could.
  if (clients_.size() < kMostAtOnce && ports::monotonic_ns() - (*longest)->used_ns < kJustCome_ns) return;
  boost::system::error_code ignored;
  (*longest)->socket.close(ignored);
}

void ControlServer::look_at_buffers() {
  const std::int64_t now_ns = ports::monotonic_ns();
  boost::system::error_code error;
  for (const auto& client : clients_) {
    if (client->socket.available(error) == 0) client->empty_ns = now_ns;
  }
  if (!clients_.empty()) look_timer_.arm(now_ns + kLook_ns);
}

asio::awaitable<void> ControlServer::serve(std::shared_ptr<Client> client) {
  std::array<char, 1024> chunk{};
  base::LineReader lines(kMaxControlLength);
  control::OrderRate rate(kMaxLines_Hz);
  asio::steady_timer pause(acceptor_.get_executor());
  for (;;) {
    const auto [error, n] = co_await client->socket.async_read_some(asio::buffer(chunk), ports::kNoThrow);
    const ControlOrigin origin{client->number, ports::monotonic_ns(), client->empty_ns};
    if (error) co_return;
    client->used_ns = origin.arrival_ns;
    if (n < chunk.size()) client->empty_ns = origin.arrival_ns;
    bool too_fast = false;
    const bool accepted = lines.feed({chunk.data(), n}, [&](std::string_view line) {
      too_fast = !rate.take(origin.arrival_ns) || too_fast;
      client->answers.push_back(answer(line, origin));
    });
    if (too_fast) owner_.control_client_gone(client->number, "its connection sends too many lines");
    if (!accepted) client->answers.emplace_back(control_error("line too long"));
    if (!std::exchange(client->is_answering, true))
      asio::co_spawn(acceptor_.get_executor(), write_answers(client),
                     [client](const std::exception_ptr& failure) { drop_after(failure, *client); });
    if (!accepted) co_return;
    // Requests that arrive during the pause stay in the client's socket; when that is full, the client has to
    // wait.
    while (too_fast || client->answers.size() > kMaxAnswers) {
      too_fast = false;
      pause.expires_after(kSlowDown);
      co_await pause.async_wait(ports::kNoThrow);
      if (!client->socket.is_open()) co_return;
    }
  }
}

void ControlServer::drop_after(const std::exception_ptr& failure, Client& client) {
  if (!failure) return;
  spdlog::warn("control socket: a client was dropped after an internal error");
  boost::system::error_code ignored;
  client.socket.close(ignored);
}

asio::awaitable<void> ControlServer::write_answers(std::shared_ptr<Client> client) {
  while (!client->answers.empty() && client->socket.is_open()) {
    asio::awaitable<std::string> line = line_of(std::move(client->answers.front()));
    client->answers.pop_front();
    const std::string text = co_await std::move(line);
    const auto [error, written] = co_await asio::async_write(client->socket, asio::buffer(text), ports::kNoThrow);
    boost::system::error_code ignored;
    if (error) client->socket.close(ignored);
  }
  client->is_answering = false;
}

asio::awaitable<std::string> ControlServer::line_of(ControlAnswer answer) {
  if (!answer.work) co_return std::move(answer.text);
  auto& pool = answer.then ? keeper_ : reader_;
  if (!pool) pool.emplace(answer.then ? kKeepers : 1);
  const auto reader = pool->get_executor();
  // Named, because g++ 12 destroys temporaries of an awaited expression twice.
  asio::awaitable<std::string> work = do_work(std::move(answer.work));
  std::string line = co_await asio::co_spawn(reader, std::move(work), asio::use_awaitable);
  co_return answer.then ? answer.then(std::move(line)) : std::move(line);
}

ControlAnswer ControlServer::answer(std::string_view line, const ControlOrigin& origin) const {
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) return control_error(*error);
  return owner_.on_control(std::get<ControlRequest>(parsed), origin);
}

}  // namespace navcal::daemon
