// SPDX-License-Identifier: Apache-2.0
#include "cli/remote_connection.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

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

base::Descriptor connect_tcp(const std::string& address) {
  const auto colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  if (host.empty() || port.empty()) throw std::runtime_error("tcp:" + address + ": tcp:HOST:PORT is expected");
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0)
    throw std::runtime_error(address + ": " + ::gai_strerror(error));
  std::string problem = "no address";
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    base::Descriptor socket(::socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (socket.get() < 0) continue;
    problem = connect_within(socket.get(), *one);
    if (!problem.empty()) continue;
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::freeaddrinfo(found);
    return socket;
  }
  ::freeaddrinfo(found);
  throw std::runtime_error(address + ": " + problem);
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

}  // namespace

RemoteConnection::RemoteConnection(const std::string& address, int baud) {
  if (address.starts_with(kTcp)) {
    socket_ = connect_tcp(address.substr(kTcp.size()));
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

}  // namespace navcal::cli
