// SPDX-License-Identifier: Apache-2.0
#include "cli/live/remote_operator.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/failure.h"
#include "base/interruptible.h"
#include "cli/live/line_socket.h"
#include "ports/finder.h"
#include "ports/tty.h"

namespace navcal::cli {
namespace {

constexpr std::string_view kTcp = "tcp:";
constexpr int kConnectWait_ms = 5000;

/// Connects within the wait. Returns why it failed; empty: connected.
std::string connect_within(int fd, const addrinfo& address) {
  if (::connect(fd, address.ai_addr, address.ai_addrlen) == 0) return {};
  if (errno != EINPROGRESS) return std::strerror(errno);
  pollfd writable{fd, POLLOUT, 0};
  if (::poll(&writable, 1, kConnectWait_ms) <= 0) return "no answer";
  int error = 0;
  socklen_t length = sizeof error;
  ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &length);
  return error == 0 ? std::string() : std::strerror(error);
}

base::Descriptor connect_to(const std::string& address) {
  const auto colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  if (host.empty() || port.empty()) throw std::runtime_error("tcp:" + address + ": tcp:HOST:PORT is expected");
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  try {
    base::Descriptor socket = connect_tcp(host, port, connect_within, SOCK_NONBLOCK);
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return socket;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(address + ": " + error.what());
  }
}

std::unique_ptr<ports::Line> open_tty(const std::string& path, int baud) {
  config::PortSettings settings;
  settings.path = path;
  std::string why;
  const auto found = ports::find_port(settings, why);
  if (!found) throw std::runtime_error(why);
  auto opened = ports::Tty::open(*found, baud, false);
  if (const auto* refusal = std::get_if<std::string>(&opened)) throw std::runtime_error(*refusal);
  return std::get<std::unique_ptr<ports::Line>>(std::move(opened));
}

using CommandKind = link::Command::Kind;

constexpr std::int64_t kSecondOfRemote_ns = 1'000'000'000;
/// An order is repeated so often in the time of a lease, and twice a second at least.
constexpr double kOrdersPerLease = 5;
constexpr std::int64_t kLongestBetweenOrders_ns = kSecondOfRemote_ns / 2;
constexpr double kGoodbye_s = 4;

link::EndOptions end_of_operator(const RemoteOperator::Options& options) {
  link::EndOptions end;
  end.budget_B_s = options.budget_B_s;
  if (options.key_file.empty()) return end;
  try {
    end.key = link::Key::from_file(options.key_file);
  } catch (const std::runtime_error& error) {
    throw base::Failure(base::Exit::bad_input, error.what());
  }
  return end;
}

}  // namespace

RemoteConnection::RemoteConnection(const std::string& address, int baud) {
  if (address.starts_with(kTcp)) {
    socket_ = connect_to(address.substr(kTcp.size()));
  } else {
    tty_ = open_tty(address, baud);
  }
}

std::optional<std::vector<std::uint8_t>> RemoteConnection::read() {
  std::vector<std::uint8_t> bytes(4096);
  const ssize_t n = ::read(fd(), bytes.data(), bytes.size());
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return std::vector<std::uint8_t>();
  if (n <= 0) return std::nullopt;
  bytes.resize(static_cast<std::size_t>(n));
  return bytes;
}

bool RemoteConnection::send(protocols::Bytes frame) {
  const ssize_t n = tty_ ? tty_->write(frame) : ::send(fd(), frame.data(), frame.size(), MSG_NOSIGNAL);
  // A frame that was taken in part fails its checksum at the other end, as one that was damaged on its way.
  return n >= 0 || errno == EAGAIN || errno == EINTR;
}

RemoteOperator::Clock::time_point RemoteOperator::after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

RemoteOperator::RemoteOperator(const Options& options)
    : options_(options), host_(end_of_operator(options)),
      connection_(std::in_place, options.address, options.baud) {}

std::int64_t RemoteOperator::now_ns() { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }

void RemoteOperator::open_again() {
  if (connection_ || now_ns() < open_again_ns_) return;
  try {
    connection_.emplace(options_.address, options_.baud);
    on_notice("the line is open again");
  } catch (const std::runtime_error&) {
    open_again_ns_ = now_ns() + kSecondOfRemote_ns;
  }
}

void RemoteOperator::pump() {
  open_again();
  watch_sessions();
  repeat_order();
  while (const auto frame = host_.next(now_ns())) {
    if (!connection_ || connection_->send(*frame)) continue;
    connection_.reset();
    open_again_ns_ = now_ns() + kSecondOfRemote_ns;
  }
}

void RemoteOperator::work(Clock::time_point until, int input) {
  pump();
  const std::int64_t now = now_ns();
  std::int64_t wake_ns = std::min(host_.deadline_ns(), std::chrono::nanoseconds(until.time_since_epoch()).count());
  if (is_leased_) wake_ns = std::min(wake_ns, order_due_ns_);
  if (!connection_) wake_ns = std::min(wake_ns, open_again_ns_);
  std::array<pollfd, 2> readable{{{connection_ ? connection_->fd() : -1, POLLIN, 0}, {input, POLLIN, 0}}};
  const auto wait_ms = static_cast<int>(std::clamp<std::int64_t>((wake_ns - now + 999'999) / 1'000'000, 0, 1000));
  const int ready = ::poll(readable.data(), readable.size(), wait_ms);
  if (ready > 0 && readable[0].revents != 0) {
    if (const auto bytes = connection_->read()) {
      host_.take(now_ns(), *bytes);
    } else {
      connection_.reset();
      open_again_ns_ = now_ns() + kSecondOfRemote_ns;
      on_notice("the line is lost; it is opened again as soon as it is back");
    }
  }
  take_command_answer();
  if (const auto why = host_.take_refusal(); why != link::Refusal::none && !host_.has_session() && why != told_) {
    told_ = why;
    on_notice(link::words_for(why));
  }
}

void RemoteOperator::watch_sessions() {
  if (host_.sessions() == sessions_) return;
  if (sessions_ > 0) {
    on_notice("navcald was started anew: nobody knows whether it executed what had not been answered");
    if (is_in_charge()) on_notice("the lease is lost");
  }
  sessions_ = host_.sessions();
  is_leasing_ = is_leased_ = false;
}

void RemoteOperator::wait_for_session(double limit_s) {
  std::string why = fmt::format("the vehicle did not answer within {:g} s (--wait)", limit_s);
  const auto notice = std::exchange(on_notice, [&](std::string_view words) { why = words; });
  const auto until = after(limit_s);
  // A refusal that was on its way to an attempt with another key is passed over.
  const auto lacks_the_key = [&] {
    return options_.key_file.empty() ? told_ == link::Refusal::untagged
                                     : told_ == link::Refusal::bad_tag || told_ == link::Refusal::no_key;
  };
  while (!host_.has_session() && Clock::now() < until && !base::Interruptible::interrupted() && !lacks_the_key())
    work(until);
  on_notice = notice;
  if (lacks_the_key() && options_.key_file.empty()) why += ": give it by --key-file FILE";
  if (!host_.has_session()) throw std::runtime_error(base::Interruptible::interrupted() ? "interrupted" : why);
}

std::string RemoteOperator::ask(std::string_view line, double limit_s) {
  if (!host_.request(line)) throw std::runtime_error("the request is too long, or there is no session");
  const unsigned session = host_.sessions();
  const auto until = after(limit_s);
  while (Clock::now() < until) {
    if (auto response = host_.take_response()) {
      while (response->ends_with('\n')) response->pop_back();
      return *response;
    }
    if (base::Interruptible::interrupted()) throw std::runtime_error("interrupted");
    if (host_.sessions() != session)
      throw std::runtime_error("navcald was started anew before it answered; perhaps it executed the request");
    work(until);
  }
  throw std::runtime_error("no answer came");
}

void RemoteOperator::give(link::Command command) {
  awaited_ = host_.command(now_ns(), std::move(command));
  if (!awaited_) answer_ = "there is no session yet";
}

void RemoteOperator::lease() {
  give({.kind = CommandKind::lease,
        .priority = static_cast<std::uint16_t>(options_.priority),
        .timeout_s = options_.lease_timeout_s,
        .holder = options_.holder});
  is_leasing_ = awaited_.has_value();
  shaft_rpm_ = 0;
  fins_deg_ = {};
}

bool RemoteOperator::order(double shaft_rpm, const std::array<double, 3>& fins_deg) {
  if (!is_leased_) return false;
  shaft_rpm_ = shaft_rpm;
  fins_deg_ = fins_deg;
  order_due_ns_ = now_ns();
  repeat_order();
  return true;
}

void RemoteOperator::repeat_order() {
  if (!is_leased_ || now_ns() < order_due_ns_) return;
  const auto lease_share_ns = static_cast<std::int64_t>(options_.lease_timeout_s / kOrdersPerLease * 1e9);
  order_due_ns_ = now_ns() + std::min(kLongestBetweenOrders_ns, lease_share_ns);
  (void)host_.command(now_ns(), {.kind = CommandKind::order, .shaft_rpm = shaft_rpm_, .fins_deg = fins_deg_});
}

void RemoteOperator::release() {
  is_leasing_ = is_leased_ = false;
  give({});
}

void RemoteOperator::stop() {
  is_leasing_ = is_leased_ = false;
  give({.kind = CommandKind::stop, .holder = options_.holder});
}

void RemoteOperator::take_command_answer() {
  const auto answer = host_.take_answer();
  if (!answer) return;
  const bool is_awaited = answer->number == awaited_;
  if (is_awaited) awaited_.reset();
  if (is_awaited || !answer->is_ok) answer_ = answer->is_ok ? "ok" : answer->error;
  if (is_awaited && std::exchange(is_leasing_, false)) {
    is_leased_ = answer->is_ok;
    order_due_ns_ = now_ns();
  } else if (!answer->is_in_charge) {
    // A lease that is over does not come back by itself; an order beyond a limit ends nothing.
    is_leased_ = false;
  }
}

void RemoteOperator::end() {
  const auto until = after(kGoodbye_s);
  if (host_.has_session() && is_in_charge()) release();
  while (host_.has_session() && awaited_ && Clock::now() < until) work(until);
  if (!host_.has_session()) return;
  host_.bye();
  while (!host_.has_said_bye() && Clock::now() < until) work(until);
}

}  // namespace navcal::cli
