// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netdb.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/descriptor.h"

namespace navcal::cli {

/// Connects a socket to an address, by `connect`; returns why it failed, or nothing.
using ConnectSocket = std::function<std::string(int socket, const addrinfo& address)>;
[[nodiscard]] std::string connect_at_once(int socket, const addrinfo& address);

/// A TCP socket with the first address of a host that can be connected. Throws std::runtime_error, which says why
/// there is none.
[[nodiscard]] base::Descriptor connect_tcp(const std::string& host, const std::string& port,
                                           const ConnectSocket& connect = connect_at_once, int socket_flags = 0);

/// A connected socket on which both sides speak in lines. Every function throws std::runtime_error when the socket
/// fails or the other side closes it; the message names the address, if there is one.
class LineSocket {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static LineSocket tcp(const std::string& host, const std::string& port);
  [[nodiscard]] static LineSocket unix_domain(const std::filesystem::path& path);
  /// `address`: for messages.
  explicit LineSocket(base::Descriptor descriptor, std::string address = {})
      : descriptor_(std::move(descriptor)), address_(std::move(address)) {}

  void send(std::string_view text);
  /// The next line without its end, or nullopt when none was whole by then, or a signal came.
  [[nodiscard]] std::optional<std::string> next(Clock::time_point until);

 private:
  [[noreturn]] void fail(std::string_view problem) const;

  base::Descriptor descriptor_;
  std::string address_;
  std::string bytes_;
};

/// Timeout for poll(2); 0 when the time has come.
[[nodiscard]] int milliseconds_until(LineSocket::Clock::time_point until);

/// Answer of navcald to a request that it has granted. Throws base::Failure with its words when it refuses.
[[nodiscard]] nlohmann::json granted_answer(const std::string& line);

/// Requests to navcald's control socket, one after the other.
class ControlLink {
 public:
  /// Throws std::runtime_error when there is no daemon.
  explicit ControlLink(const std::filesystem::path& control) : socket_(LineSocket::unix_domain(control)) {}

  /// The daemon's answer to a request that it has granted. Throws base::Failure with the daemon's words when
  /// it refuses.
  nlohmann::json ask(const nlohmann::json& request);

 private:
  LineSocket socket_;
};

}  // namespace navcal::cli
