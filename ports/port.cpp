// SPDX-License-Identifier: Apache-2.0
#include "ports/port.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "ports/finder.h"
#include "ports/no_throw.h"
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
constexpr milliseconds kAfterEmptyRead{10};
constexpr int kEmptyReads = 20;

}  // namespace

struct Port::State : std::enable_shared_from_this<Port::State> {
  State(asio::any_io_executor executor, config::PortSettings port_settings, PortListener& port_listener)
      : settings(std::move(port_settings)), listener(port_listener), descriptor(executor), timer(executor) {
    outgoing.reserve(kSendBytes);
  }

  awaitable<void> run(std::shared_ptr<State> self);
  awaitable<std::string> read_until_lost();
  awaitable<void> pause(milliseconds duration);
  /// Empty when the port is open now; else why it is not, and when to try again.
  std::string open(milliseconds& again_after);
  void close();
  void tell(const std::string& reason);
  /// Reads all that is there after one wake-up. Empty, or why the port is lost.
  std::string drain(std::int64_t arrival_ns);
  void write_some();

  config::PortSettings settings;
  PortListener& listener;
  asio::posix::stream_descriptor descriptor;  // borrows the descriptor of tty
  asio::steady_timer timer;
  std::optional<Tty> tty;
  std::vector<std::string> told;  // reasons since the port was last open
  std::array<std::uint8_t, kReadBytes> buffer{};
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
      reason = open(again_after);
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

std::string Port::State::open(milliseconds& again_after) {
  std::string why;
  const auto found = find_port(settings, why);
  if (!found) return why;
  auto opened = Tty::open(*found, settings.baud, settings.low_latency);
  if (auto* refusal = std::get_if<std::string>(&opened)) {
    again_after = kTryAgain;
    return std::move(*refusal);
  }
  tty.emplace(std::get<Tty>(std::move(opened)));
  descriptor.assign(tty->fd());
  told.clear();
  empty_reads = 0;
  listener.on_opened(monotonic_ns(), tty->info());
  return {};
}

void Port::State::close() {
  if (!tty) return;
  descriptor.release();  // ends what waits on it, and leaves the closing to its owner
  tty.reset();
  outgoing.clear();
}

void Port::State::tell(const std::string& reason) {
  if (std::find(told.begin(), told.end(), reason) != told.end()) return;
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
    if (error) co_return error.message();
    if (std::string lost = drain(arrival_ns); !lost.empty()) co_return lost;
    // A tty that reads as empty is ready again at once; without a pause it would eat a core.
    if (!stopped && empty_reads > 0) co_await pause(kAfterEmptyRead);
  }
  co_return std::string{};
}

std::string Port::State::drain(std::int64_t arrival_ns) {
  for (;;) {
    const ssize_t n = ::read(tty->fd(), buffer.data(), buffer.size());
    if (n < 0) {
      if (errno == EAGAIN) return {};
      if (errno == EINTR) continue;
      return tty->info().path + ": " + std::strerror(errno);
    }
    if (n == 0) {
      if (!tty->alive()) return tty->info().path + ": the device is gone";
      // The device is there and yet reads end: its settings were changed by another program. Opening it anew
      // restores them.
      if (++empty_reads < kEmptyReads) return {};
      return tty->info().path + ": reads end at once although the device is there";
    }
    empty_reads = 0;
    const auto size = static_cast<std::size_t>(n);
    listener.on_bytes(arrival_ns, protocols::Bytes(buffer.data(), size));
    if (stopped || size < buffer.size()) return {};
    arrival_ns = monotonic_ns();
  }
}

void Port::State::write_some() {
  writing = true;
  descriptor.async_write_some(
      asio::buffer(outgoing), [self = shared_from_this()](const boost::system::error_code& error, std::size_t n) {
        self->writing = false;
        if (self->stopped) return;
        // After an error the reading side finds out what became of the port.
        if (error) return self->outgoing.clear();
        n = std::min(n, self->outgoing.size());
        self->listener.on_sent(monotonic_ns(), protocols::Bytes(self->outgoing.data(), n));
        if (self->stopped) return;
        self->outgoing.erase(self->outgoing.begin(), self->outgoing.begin() + static_cast<std::ptrdiff_t>(n));
        if (!self->outgoing.empty()) self->write_some();
      });
}

Port::Port(asio::any_io_executor executor, config::PortSettings settings, PortListener& listener)
    : state_(std::make_shared<State>(std::move(executor), std::move(settings), listener)) {}

Port::~Port() { stop(); }

void Port::start() { asio::co_spawn(state_->timer.get_executor(), state_->run(state_), asio::detached); }

void Port::send(protocols::Bytes bytes) {
  State& state = *state_;
  if (!state.tty || state.outgoing.size() + bytes.size() > kSendBytes) return;
  state.outgoing.insert(state.outgoing.end(), bytes.begin(), bytes.end());
  if (!state.writing) state.write_some();
}

std::optional<std::int64_t> Port::send_now(protocols::Bytes bytes) {
  State& state = *state_;
  if (!state.tty || state.writing || !state.outgoing.empty()) return std::nullopt;
  const ssize_t n = ::write(state.tty->fd(), bytes.data(), bytes.size());
  const std::int64_t now_ns = monotonic_ns();
  // After an error the reading side finds out what became of the port.
  if (n <= 0) return std::nullopt;
  const auto taken = static_cast<std::size_t>(n);
  state.listener.on_sent(now_ns, bytes.first(taken));
  return taken == bytes.size() ? std::optional(now_ns) : std::nullopt;
}

void Port::flush(milliseconds limit) {
  const State& state = *state_;
  if (!state.tty) return;
  const auto end = std::chrono::steady_clock::now() + limit;
  int waiting = 0;
  while (::ioctl(state.tty->fd(), TIOCOUTQ, &waiting) == 0 && waiting > 0 &&
         std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(1));
  // The driver has handed over all; the UART's own FIFO holds sixteen bytes of ten bits.
  if (!state.tty->info().pseudo_terminal)
    std::this_thread::sleep_for(std::chrono::microseconds(160'000'000 / state.settings.baud));
}

void Port::stop() {
  if (state_->stopped) return;
  state_->stopped = true;
  state_->timer.cancel();
  state_->close();
}

}  // namespace navcal::ports
