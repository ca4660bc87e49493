// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <stdexcept>
#include <string_view>

#include "link/host.h"

namespace navcal::daemon {

using nlohmann::json;
using RemoteTime = std::chrono::steady_clock;

inline constexpr std::string_view kRemoteSecret = "the secret of this test, long enough";

inline std::int64_t remote_now_ns() {
  return std::chrono::nanoseconds(RemoteTime::now().time_since_epoch()).count();
}

inline link::EndOptions remote_options(std::string_view key) {
  link::EndOptions options;
  if (!key.empty()) options.key = link::Key::from_text(key);
  return options;
}

/// An operator on a descriptor. Loses frames both ways as it is told.
class Operator {
 public:
  Operator(int fd, std::string_view key) : host(remote_options(key)), fd_(fd) { ::fcntl(fd, F_SETFL, O_NONBLOCK); }
  ~Operator() { ::close(fd_); }
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;

  /// Works, and lets the card speak, until the condition holds; false after a long time.
  template <class Condition>
  bool until(Condition holds, double limit_s = 30) {
    const auto end = RemoteTime::now() + std::chrono::duration<double>(limit_s);
    while (RemoteTime::now() < end) {
      while (const auto frame = host.next(remote_now_ns())) {
        if (!is_cut && !is_lost())
          if (::write(fd_, frame->data(), frame->size()) < 0) return false;
      }
      pollfd readable{fd_, POLLIN, 0};
      ::poll(&readable, 1, 5);
      std::uint8_t bytes[4096];
      const ssize_t n = ::read(fd_, bytes, sizeof bytes);
      if (n > 0 && !is_cut && !is_lost()) host.take(remote_now_ns(), {bytes, static_cast<std::size_t>(n)});
      if (work) work();
      if (holds()) return true;
    }
    return false;
  }
  bool connect() {
    return until([&] { return host.has_session() && host.quality().round_trip_s; });
  }
  link::CommandAnswer ask(const link::Command& command) {
    if (!host.command(remote_now_ns(), command)) throw std::runtime_error("no session");
    std::optional<link::CommandAnswer> answer;
    if (!until([&] { return (answer = host.take_answer()).has_value(); })) throw std::runtime_error("no answer");
    return *answer;
  }
  link::CommandAnswer lease(double timeout_s = 5) {
    link::Command command;
    command.kind = link::Command::Kind::lease;
    command.priority = 10;
    command.timeout_s = timeout_s;
    command.holder = "operator";
    return ask(command);
  }
  link::CommandAnswer order(double rpm) {
    link::Command command;
    command.kind = link::Command::Kind::order;
    command.shaft_rpm = rpm;
    return ask(command);
  }
  json request(std::string_view line) {
    if (!host.request(line)) throw std::runtime_error("no session");
    std::optional<std::string> response;
    if (!until([&] { return (response = host.take_response()).has_value(); }, 60))
      throw std::runtime_error("no response");
    return json::parse(*response);
  }

  link::Host host;
  std::function<void()> work;
  bool is_cut = false;
  double loss = 0;

 private:
  bool is_lost() { return loss > 0 && static_cast<double>(random_() % 1000) < 1000 * loss; }

  int fd_;
  std::mt19937 random_{1};
};

inline int tcp_to(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("no connection to the link");
  return fd;
}

}  // namespace navcal::daemon
