// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace navcal::daemon {

/// A client of the daemon's sockets, with plain blocking calls and a time limit.
class Client {
 public:
  static constexpr auto kPatience = std::chrono::seconds(20);

  explicit Client(std::uint16_t port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) fail("connect");
  }
  explicit Client(const std::filesystem::path& path) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) fail("connect");
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(std::string_view text) {
    if (::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) < 0) fail("send");
  }

  /// The next line; nullopt when the connection was closed. Throws when nothing comes.
  std::optional<std::string> line() {
    for (;;) {
      if (const auto end = bytes_.find('\n'); end != std::string::npos) {
        std::string line = bytes_.substr(0, end);
        bytes_.erase(0, end + 1);
        return line;
      }
      pollfd readable{socket_, POLLIN, 0};
      if (::poll(&readable, 1, static_cast<int>(std::chrono::milliseconds(kPatience).count())) <= 0)
        fail("no line");
      std::array<char, 65536> chunk{};
      const ssize_t n = ::recv(socket_, chunk.data(), chunk.size(), 0);
      if (n <= 0) return std::nullopt;
      bytes_.append(chunk.data(), static_cast<std::size_t>(n));
    }
  }

  /// The next line that contains `text`; passes over others.
  std::string line_with(std::string_view text) {
    while (auto next = line()) {
      if (next->find(text) != std::string::npos) return *next;
    }
    throw std::runtime_error("closed before a line with " + std::string(text));
  }

  /// The received part of an incomplete line.
  [[nodiscard]] const std::string& rest() const { return bytes_; }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error("client: " + what); }

  int socket_;
  std::string bytes_;
};

}  // namespace navcal::daemon
