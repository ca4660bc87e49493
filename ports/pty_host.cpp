// SPDX-License-Identifier: Apache-2.0
#include "ports/pty_host.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <chrono>

#include "ports/no_throw.h"
#include "ports/port.h"
#include "ports/pseudo_terminal.h"
#include "ports/raw_mode.h"

namespace navcal::ports {
namespace {

namespace asio = boost::asio;
/// Interval of looking for a client. Without a client the master is always "ready", so it cannot be waited for.
constexpr std::chrono::milliseconds kLookForClient{20};

}  // namespace

struct PtyHost::State : std::enable_shared_from_this<PtyHost::State> {
  State(const asio::any_io_executor& executor, std::filesystem::path link_path, int baud_rate, OnBytes callback)
      : link(std::move(link_path)), baud(baud_rate), on_bytes(std::move(callback)), descriptor(executor),
        timer(executor) {}

  void plug();
  void unplug();
  asio::awaitable<void> read(std::shared_ptr<State> self, unsigned my_plugging);
  /// False when the client has gone (or never came).
  bool take_what_is_there(unsigned my_plugging);
  void forget_unread() const;
  [[nodiscard]] bool has_client() const;

  std::filesystem::path link;
  int baud;
  OnBytes on_bytes;
  asio::posix::stream_descriptor descriptor;  // borrows the master
  asio::steady_timer timer;
  base::Descriptor kept;  ///< the name of the link
  PseudoTerminal terminal;
  unsigned pluggings = 0;  // separates the reading coroutine of an earlier terminal from this one's
  Tally tally;
};

void PtyHost::State::plug() {
  terminal = make_pseudo_terminal(baud);
  point_link(link, terminal.slave_name);
  descriptor.assign(terminal.master.get());
  ++pluggings;
  asio::co_spawn(timer.get_executor(), read(shared_from_this(), pluggings), asio::detached);
}

void PtyHost::State::unplug() {
  if (!terminal.master) return;
  ++pluggings;
  timer.cancel();
  descriptor.release();
  remove_link(link, terminal.slave_name);
  terminal = PseudoTerminal{};
}

bool PtyHost::State::has_client() const {
  pollfd state{terminal.master.get(), POLLOUT, 0};
  return terminal.master && ::poll(&state, 1, 0) >= 0 && (state.revents & POLLHUP) == 0;
}

/// Discards the unread bytes, as a closed port does, so that the next client does not get them.
void PtyHost::State::forget_unread() const {
  const base::Descriptor slave(::open(terminal.slave_name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (slave) ::tcflush(slave.get(), TCIFLUSH);
}

asio::awaitable<void> PtyHost::State::read(std::shared_ptr<State> /*self: keeps the state alive*/,
                                           unsigned my_plugging) {
  while (pluggings == my_plugging) {
    if (has_client()) {
      co_await descriptor.async_wait(asio::posix::stream_descriptor::wait_read, kNoThrow);
      if (pluggings != my_plugging) break;
      if (take_what_is_there(my_plugging)) continue;
      if (pluggings != my_plugging) break;
      if (!has_client()) forget_unread();
    }
    timer.expires_after(kLookForClient);
    co_await timer.async_wait(kNoThrow);
    // A client may have come, written and gone in between.
    if (pluggings == my_plugging && !has_client()) take_what_is_there(my_plugging);
  }
}

bool PtyHost::State::take_what_is_there(unsigned my_plugging) {
  std::array<std::uint8_t, 4096> buffer{};
  for (;;) {
    const ssize_t n = ::read(terminal.master.get(), buffer.data(), buffer.size());
    if (n < 0) return errno == EAGAIN || errno == EINTR;  // EIO: the last client has closed
    if (n == 0) return false;
    on_bytes(monotonic_ns(), protocols::Bytes(buffer.data(), static_cast<std::size_t>(n)));
    if (pluggings != my_plugging || static_cast<std::size_t>(n) < buffer.size()) return true;
  }
}

PtyHost::PtyHost(const asio::any_io_executor& executor, std::filesystem::path link, int baud, OnBytes on_bytes)
    : state_(std::make_shared<State>(executor, std::move(link), baud, std::move(on_bytes))) {
  state_->kept = keep_link(state_->link);
  state_->plug();
}

PtyHost::~PtyHost() {
  state_->unplug();
  state_->kept = base::Descriptor();
}

std::size_t PtyHost::write(protocols::Bytes bytes) {
  Tally& tally = state_->tally;
  if (!has_client()) {
    tally.unheard += bytes.size();
    return 0;
  }
  const ssize_t n = ::write(state_->terminal.master.get(), bytes.data(), bytes.size());
  const std::size_t taken = n > 0 ? static_cast<std::size_t>(n) : 0;
  tally.taken += taken;
  tally.overrun += bytes.size() - taken;
  return taken;
}

void PtyHost::unplug() { state_->unplug(); }

void PtyHost::replug() {
  if (!plugged()) state_->plug();
}

bool PtyHost::plugged() const { return static_cast<bool>(state_->terminal.master); }
bool PtyHost::has_client() const { return state_->has_client(); }

std::size_t PtyHost::unread() const {
  if (!has_client()) return 0;
  const base::Descriptor slave(
      ::open(state_->terminal.slave_name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  int count = 0;
  if (!slave || ::ioctl(slave.get(), FIONREAD, &count) != 0) return 0;
  return static_cast<std::size_t>(count);
}

int PtyHost::client_baud() const {
  termios settings{};
  if (!plugged() || ::tcgetattr(state_->terminal.master.get(), &settings) != 0) return 0;
  return baud_of(::cfgetospeed(&settings));
}

const PtyHost::Tally& PtyHost::tally() const { return state_->tally; }
const std::filesystem::path& PtyHost::link() const { return state_->link; }
std::string PtyHost::device() const { return state_->terminal.slave_name; }

}  // namespace navcal::ports
