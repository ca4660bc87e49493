// SPDX-License-Identifier: Apache-2.0
#include "ports/port.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <utility>
#include <variant>
#include <vector>

#include "base/descriptor.h"
#include "config/network_address.h"
#include "ports/finder.h"
#include "ports/line.h"
#include "ports/network_line.h"
#include "ports/no_throw.h"
#include "ports/sample_socket.h"
#include "ports/tty.h"

namespace navcal::ports {
namespace {

namespace asio = boost::asio;
using asio::awaitable;
using std::chrono::milliseconds;

constexpr std::size_t kReadBytes = 4096;
constexpr std::size_t kSendBytes = 4096;
constexpr milliseconds kLookAgain{200};  // a device that is not there
constexpr milliseconds kTryAgain{500};   // one that is there and cannot be opened: finding out why costs more
constexpr milliseconds kConnect{5000};
constexpr milliseconds kAfterEmptyRead{10};
constexpr int kEmptyReads = 20;

}  // namespace

struct Port::State : std::enable_shared_from_this<Port::State> {
  State(const asio::any_io_executor& executor, config::PortSettings port_settings, PortListener& port_listener)
      : settings(std::move(port_settings)), listener(port_listener), descriptor(executor), timer(executor),
        address(config::parse_network_address(settings.address)), door(executor),
        buffer(address ? kLargestDatagram_bytes : kReadBytes) {
    outgoing.reserve(kSendBytes);
  }

  awaitable<void> run(std::shared_ptr<State> self);
  awaitable<std::string> read_until_lost();
  awaitable<void> pause(milliseconds duration);
  /// Empty when the port is open now; else why it is not, and when to try again.
  awaitable<std::string> open(milliseconds& again_after);
  std::string open_tty(milliseconds& again_after);
  /// Empty, or why there is no line.
  std::string take(std::variant<std::unique_ptr<Line>, std::string> opened);
  awaitable<std::string> connect(const config::NetworkAddress& address);
  /// Empty, or why nobody can connect.
  std::string listen();
  awaitable<std::string> accept();
  /// True when the socket is ready; false when it is not within the limit (0: none), or the port was stopped.
  awaitable<bool> ready(int socket, asio::posix::stream_descriptor::wait_type type, milliseconds limit);
  /// A device that connects while another one is connected takes its place.
  void watch_door();
  void close();
  void tell(const std::string& reason);
  /// Reads all that is there after one wake-up. Empty, or why the port is lost.
  std::string drain(std::int64_t arrival_ns);
  /// Writes in the next turn of the loop, without a wait for the port to become ready: Asio would keep watching
  /// the port for that, and each read would then wake the loop twice.
  void write_soon();
  void write_some();
  void write_when_ready();
  void drop_outgoing();

  config::PortSettings settings;
  PortListener& listener;
  asio::posix::stream_descriptor descriptor;  // borrows the descriptor of line
  asio::steady_timer timer;
  const std::optional<config::NetworkAddress> address;  // of a port without a tty
  std::unique_ptr<Line> line;
  asio::posix::stream_descriptor door;  // borrows the descriptor of listening
  base::Descriptor listening;
  std::unique_ptr<Line> newcomer;  // connected, and waits until the line before it is closed
  std::uint64_t waits = 0;         // number of the last ready()
  std::vector<std::string> told;   // reasons since the port was last open
  std::vector<std::uint8_t> buffer;
  std::vector<std::uint8_t> outgoing;
  bool writing = false;
  int empty_reads = 0;
  bool stopped = false;
};

awaitable<void> Port::State::run(std::shared_ptr<State> /*self: keeps the state alive*/) {
  while (!stopped) {
    milliseconds again_after = kLookAgain;
    std::string reason;
    try {
      reason = co_await open(again_after);
      if (reason.empty()) reason = co_await read_until_lost();
    } catch (const std::exception& error) {
      reason = std::string("failure inside navcald: ") + error.what();
    }
    close();
    if (stopped) co_return;
    tell(reason);
    if (!stopped) co_await pause(again_after);
  }
}

awaitable<std::string> Port::State::open(milliseconds& again_after) {
  std::string why;
  if (!address) {
    why = open_tty(again_after);
  } else if (address->kind == config::NetworkAddress::Kind::tcp) {
    again_after = kTryAgain;
    why = co_await connect(*address);
  } else if (address->kind == config::NetworkAddress::Kind::tcp_listen) {
    why = co_await accept();
  } else if (address->kind == config::NetworkAddress::Kind::unix_listen) {
    why = take(open_sample_socket(address->host));
  } else {
    why = take(bind_datagrams(*address));
  }
  if (!why.empty() || stopped) co_return why;
  descriptor.assign(line->fd());
  told.clear();
  empty_reads = 0;
  listener.on_opened(monotonic_ns(), line->info());
  co_return std::string{};
}

std::string Port::State::open_tty(milliseconds& again_after) {
  std::string why;
  const auto found = find_port(settings, why);
  if (!found) return why;
  why = take(Tty::open(*found, settings.baud, settings.low_latency));
  if (!why.empty()) again_after = kTryAgain;
  return why;
}

std::string Port::State::take(std::variant<std::unique_ptr<Line>, std::string> opened) {
  if (auto* refusal = std::get_if<std::string>(&opened)) return std::move(*refusal);
  line = std::get<std::unique_ptr<Line>>(std::move(opened));
  return {};
}

awaitable<bool> Port::State::ready(int socket, asio::posix::stream_descriptor::wait_type type,
                                   milliseconds limit) {
  const std::uint64_t number = ++waits;
  descriptor.assign(socket);
  if (limit.count() > 0) {
    timer.expires_after(limit);
    timer.async_wait([self = shared_from_this(), number](const boost::system::error_code& error) {
      // An expiry that was queued before its wait was over must not end the next one.
      if (!error && number == self->waits && self->descriptor.is_open()) self->descriptor.cancel();
    });
  }
  const auto [error] = co_await descriptor.async_wait(type, kNoThrow);
  ++waits;
  timer.cancel();
  if (descriptor.is_open()) descriptor.release();
  co_return !error && !stopped;
}

awaitable<std::string> Port::State::connect(const config::NetworkAddress& to) {
  auto begun = begin_connect(to);
  if (auto* refusal = std::get_if<std::string>(&begun)) co_return std::move(*refusal);
  auto& socket = std::get<base::Descriptor>(begun);
  if (!co_await ready(socket.get(), asio::posix::stream_descriptor::wait_write, kConnect)) {
    co_return fmt::format("{}: no answer within {} s", settings.address, kConnect.count() / 1000);
  }
  co_return take(finish_connect(to, std::move(socket)));
}

std::string Port::State::listen() {
  if (listening) return {};
  auto opened = listen_at(*address);
  if (auto* refusal = std::get_if<std::string>(&opened)) return std::move(*refusal);
  listening = std::get<base::Descriptor>(std::move(opened));
  door.assign(listening.get());
  return {};
}

awaitable<std::string> Port::State::accept() {
  if (newcomer) {
    line = std::move(newcomer);
    watch_door();
    co_return std::string{};
  }
  if (std::string refusal = listen(); !refusal.empty()) co_return refusal;
  tell(fmt::format("{}: waiting for a device that connects", settings.address));
  while (!stopped && !line) {
    const auto [error] = co_await door.async_wait(asio::posix::stream_descriptor::wait_read, kNoThrow);
    if (error) co_return error.message();
    line = accept_at(listening.get());
  }
  if (!stopped) watch_door();
  co_return std::string{};
}

void Port::State::watch_door() {
  door.async_wait(asio::posix::stream_descriptor::wait_read,
                  [self = shared_from_this()](const boost::system::error_code& error) {
                    if (error || self->stopped || !self->line) return;
                    self->newcomer = accept_at(self->listening.get());
                    if (!self->newcomer) return self->watch_door();
                    self->descriptor.cancel();
                  });
}

void Port::State::close() {
  // Releasing ends what waits on a descriptor, and leaves the closing to its owner.
  if (descriptor.is_open()) descriptor.release();
  if (stopped) {
    if (door.is_open()) door.release();
    listening = base::Descriptor();
    newcomer.reset();
  } else if (line && door.is_open()) {
    door.cancel();
  }
  line.reset();
  drop_outgoing();
}

void Port::State::drop_outgoing() {
  if (!stopped && !outgoing.empty()) listener.on_dropped(outgoing);
  outgoing.clear();
}

void Port::State::tell(const std::string& reason) {
  if (std::ranges::find(told, reason) != told.end()) return;
  told.push_back(reason);
  listener.on_lost(monotonic_ns(), reason);
}

awaitable<void> Port::State::pause(milliseconds duration) {
  timer.expires_after(duration);
  co_await timer.async_wait(kNoThrow);
}

awaitable<std::string> Port::State::read_until_lost() {
  while (!stopped) {
    const auto [error] = co_await descriptor.async_wait(asio::posix::stream_descriptor::wait_read, kNoThrow);
    const std::int64_t arrival_ns = monotonic_ns();
    if (stopped) break;
    if (newcomer) co_return fmt::format("{}: another device has connected", line->info().path);
    if (error) co_return error.message();
    if (std::string lost = drain(arrival_ns); !lost.empty()) co_return lost;
    // A tty that reads as empty is ready again at once; without a pause it would eat a core.
    if (!stopped && empty_reads > 0) co_await pause(kAfterEmptyRead);
  }
  co_return std::string{};
}

std::string Port::State::drain(std::int64_t arrival_ns) {
  for (;;) {
    const ssize_t n = line->read(buffer);
    if (n < 0) {
      if (errno == EAGAIN) return {};
      if (errno == EINTR) continue;
      return line->info().path + ": " + std::strerror(errno);
    }
    if (n == 0) {
      if (std::string end = line->ended(); !end.empty()) return end;
      // The device is there and yet reads end: its settings were changed by another program. Opening it anew
      // restores them.
      if (++empty_reads < kEmptyReads) return {};
      return line->info().path + ": reads end at once although the device is there";
    }
    empty_reads = 0;
    const auto size = static_cast<std::size_t>(n);
    listener.on_bytes(arrival_ns, protocols::Bytes(buffer.data(), size));
    if (stopped || size < buffer.size()) return {};
    arrival_ns = monotonic_ns();
  }
}

void Port::State::write_soon() {
  writing = true;
  asio::post(timer.get_executor(), [self = shared_from_this()] { self->write_some(); });
}

void Port::State::write_some() {
  writing = false;
  if (stopped || !line || outgoing.empty()) return;
  const ssize_t taken = line->write(outgoing);
  if (taken < 0 && (errno == EAGAIN || errno == EINTR)) return write_when_ready();
  // After an error the reading side finds out what became of the port.
  if (taken < 0) return drop_outgoing();
  const auto n = std::min(static_cast<std::size_t>(taken), outgoing.size());
  listener.on_sent(monotonic_ns(), protocols::Bytes(outgoing.data(), n));
  if (stopped) return;
  outgoing.erase(outgoing.begin(), outgoing.begin() + static_cast<std::ptrdiff_t>(n));
  if (!outgoing.empty() && !writing) write_when_ready();
}

void Port::State::write_when_ready() {
  writing = true;
  descriptor.async_wait(asio::posix::stream_descriptor::wait_write,
                        [self = shared_from_this()](const boost::system::error_code& error) {
                          self->writing = false;
                          if (error) return self->drop_outgoing();
                          self->write_some();
                        });
}

Port::Port(const asio::any_io_executor& executor, config::PortSettings settings, PortListener& listener)
    : state_(std::make_shared<State>(executor, std::move(settings), listener)) {}

Port::~Port() { stop(); }

std::string Port::listen() { return state_->address ? state_->listen() : "no address"; }

void Port::start() { asio::co_spawn(state_->timer.get_executor(), state_->run(state_), asio::detached); }

void Port::send(protocols::Bytes bytes) {
  State& state = *state_;
  if (state.address && state.address->kind == config::NetworkAddress::Kind::udp) {
    if (!send_now(bytes)) state.listener.on_dropped(bytes);
    return;
  }
  if (!state.line || state.outgoing.size() + bytes.size() > kSendBytes) return state.listener.on_dropped(bytes);
  state.outgoing.insert(state.outgoing.end(), bytes.begin(), bytes.end());
  if (!state.writing) state.write_soon();
}

std::optional<std::int64_t> Port::send_now(protocols::Bytes bytes) {
  State& state = *state_;
  if (!state.line || state.writing || !state.outgoing.empty()) return std::nullopt;
  const ssize_t n = state.line->write(bytes);
  const std::int64_t now_ns = monotonic_ns();
  // After an error the reading side finds out what became of the port.
  if (n <= 0) return std::nullopt;
  const auto taken = static_cast<std::size_t>(n);
  state.listener.on_sent(now_ns, bytes.first(taken));
  return taken == bytes.size() ? std::optional(now_ns) : std::nullopt;
}

void Port::flush(milliseconds limit) {
  if (state_->line) state_->line->flush(limit);
}

void Port::stop() {
  if (state_->stopped) return;
  state_->stopped = true;
  state_->timer.cancel();
  state_->close();
}

}  // namespace navcal::ports
