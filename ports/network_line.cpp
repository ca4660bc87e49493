// SPDX-License-Identifier: Apache-2.0
#include "ports/network_line.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cerrno>
#include <cstring>
#include <optional>

namespace navcal::ports {
namespace {

namespace ip = boost::asio::ip;
using config::NetworkAddress;

/// A peer that has lost its power says nothing. The system asks it after this silence, and gives up after that
/// many questions: the connection ends after 25 s. So it does when the peer takes no bytes: what waits for it
/// grows old in the system's buffer, which holds minutes of a slow stream.
constexpr int kKeepAliveIdle_s = 10, kKeepAliveInterval_s = 5, kKeepAliveProbes = 3, kUntaken_ms = 25'000;

ip::tcp::endpoint endpoint_of(const NetworkAddress& address) {
  return {ip::make_address(address.host == "localhost" ? "127.0.0.1" : address.host), address.port};
}

std::string text_of(std::string_view kind, const ip::tcp::endpoint& endpoint) {
  const bool in_brackets = endpoint.address().is_v6();
  return fmt::format("{}:{}{}{}:{}", kind, in_brackets ? "[" : "", endpoint.address().to_string(),
                     in_brackets ? "]" : "", endpoint.port());
}

std::string_view kind_of(const NetworkAddress& address) {
  switch (address.kind) {
    case NetworkAddress::Kind::tcp: return "tcp";
    case NetworkAddress::Kind::tcp_listen: return "tcp-listen";
    case NetworkAddress::Kind::udp:
    case NetworkAddress::Kind::unix_listen: break;
  }
  return "udp";
}

std::string refusal(const NetworkAddress& address, int error) {
  const bool no_network = error == EAFNOSUPPORT || error == ENETUNREACH || error == EPERM;
  return fmt::format(
      "{}: {}{}", text_of(kind_of(address), endpoint_of(address)), std::strerror(error),
      no_network ? " (the service has no network unless it is given one: docs/network-ports.md)" : "");
}

std::optional<base::Descriptor> open_socket(const ip::tcp::endpoint& endpoint, int type) {
  base::Descriptor socket(::socket(endpoint.protocol().family(), type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return std::nullopt;
  return socket;
}

void set_option(int socket, int level, int name, int value) {
  // An option that the system does not have is one convenience less, and nothing is lost by it.
  ::setsockopt(socket, level, name, &value, sizeof value);
}

void set_up_stream(int socket) {
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(socket, IPPROTO_TCP, TCP_KEEPIDLE, kKeepAliveIdle_s);
  set_option(socket, IPPROTO_TCP, TCP_KEEPINTVL, kKeepAliveInterval_s);
  set_option(socket, IPPROTO_TCP, TCP_KEEPCNT, kKeepAliveProbes);
  set_option(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, kUntaken_ms);
}

/// TCP connections and datagrams alike.
class NetworkLine : public Line {
 public:
  NetworkLine(base::Descriptor socket, std::string path) : socket_(std::move(socket)) {
    info_.path = std::move(path);
    info_.is_network = true;
    info_.low_latency = "not applicable on a network connection";
  }
  [[nodiscard]] int fd() const override { return socket_.get(); }
  [[nodiscard]] const OpenPort& info() const override { return info_; }
  void flush(std::chrono::milliseconds /*limit*/) const override {
  }  // closing a socket loses nothing that was sent

 private:
  base::Descriptor socket_;
  OpenPort info_;
};

class Stream final : public NetworkLine {
 public:
  using NetworkLine::NetworkLine;
  [[nodiscard]] ssize_t read(std::span<std::uint8_t> buffer) override {
    return ::recv(fd(), buffer.data(), buffer.size(), 0);
  }
  [[nodiscard]] ssize_t write(protocols::Bytes bytes) override {
    return ::send(fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  [[nodiscard]] std::string ended() const override { return info().path + ": the device closed the connection"; }
};

class Datagrams final : public NetworkLine {
 public:
  using NetworkLine::NetworkLine;
  [[nodiscard]] ssize_t read(std::span<std::uint8_t> buffer) override {
    for (;;) {
      sender_length_ = sizeof sender_;
      const ssize_t n = ::recvfrom(fd(), buffer.data(), buffer.size(), 0, address(), &sender_length_);
      // A datagram may be empty. An answer that nobody took comes back as an error, and says nothing of this port.
      if (n > 0 || (n < 0 && errno != ECONNREFUSED)) return n;
    }
  }
  [[nodiscard]] ssize_t write(protocols::Bytes bytes) override {
    if (sender_length_ == 0) {
      errno = ENOTCONN;
      return -1;
    }
    return ::sendto(fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL, address(), sender_length_);
  }
  [[nodiscard]] std::string ended() const override { return {}; }

 private:
  [[nodiscard]] sockaddr* address() { return reinterpret_cast<sockaddr*>(&sender_); }

  sockaddr_storage sender_{};
  socklen_t sender_length_ = 0;  ///< 0: nobody has sent anything yet
};

}  // namespace

std::variant<base::Descriptor, std::string> begin_connect(const NetworkAddress& address) {
  const auto endpoint = endpoint_of(address);
  auto socket = open_socket(endpoint, SOCK_STREAM);
  if (!socket) return refusal(address, errno);
  set_up_stream(socket->get());
  if (::connect(socket->get(), endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0 &&
      errno != EINPROGRESS)
    return refusal(address, errno);
  return std::move(*socket);
}

std::variant<std::unique_ptr<Line>, std::string> finish_connect(const NetworkAddress& address,
                                                                base::Descriptor socket) {
  int error = 0;
  socklen_t length = sizeof error;
  if (::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &length) != 0) error = errno;
  if (error != 0) return refusal(address, error);
  return std::make_unique<Stream>(std::move(socket), text_of("tcp", endpoint_of(address)));
}

std::variant<base::Descriptor, std::string> listen_at(const NetworkAddress& address) {
  const auto endpoint = endpoint_of(address);
  auto socket = open_socket(endpoint, SOCK_STREAM);
  if (!socket) return refusal(address, errno);
  set_option(socket->get(), SOL_SOCKET, SO_REUSEADDR, 1);  // a daemon that starts again finds its port free
  if (::bind(socket->get(), endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0 ||
      ::listen(socket->get(), 4) != 0)
    return refusal(address, errno);
  return std::move(*socket);
}

std::unique_ptr<Line> accept_at(int listening) {
  ip::tcp::endpoint peer;
  auto length = static_cast<socklen_t>(peer.capacity());
  base::Descriptor socket(::accept4(listening, peer.data(), &length, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return nullptr;
  peer.resize(length);
  set_up_stream(socket.get());
  return std::make_unique<Stream>(std::move(socket), text_of("tcp", peer));
}

std::variant<std::unique_ptr<Line>, std::string> bind_datagrams(const NetworkAddress& address) {
  const auto endpoint = endpoint_of(address);
  auto socket = open_socket(endpoint, SOCK_DGRAM);
  if (!socket) return refusal(address, errno);
  if (::bind(socket->get(), endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0)
    return refusal(address, errno);
  return std::make_unique<Datagrams>(std::move(*socket), text_of("udp", endpoint));
}

}  // namespace navcal::ports
