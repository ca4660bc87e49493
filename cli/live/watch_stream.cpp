// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "cli/live/line_socket.h"

namespace navcal::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kRetry = std::chrono::milliseconds(500);
/// Upper limit of a line; no program that uses this protocol sends a longer one.
constexpr std::size_t kMaxLine = 1 << 20;

int milliseconds_until(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

}  // namespace

WatchStream::WatchStream(std::string host, std::string port, std::string_view request)
    : host_(std::move(host)), port_(std::move(port)), request_(request) {}

void WatchStream::disconnect(std::string problem) {
  socket_ = {};
  bytes_.clear();
  problem_ = std::move(problem);
  next_attempt_ = Clock::now() + kRetry;
}

bool WatchStream::connect() {
  const auto connect_and_ask = [this](int candidate, const addrinfo& address) {
    if (std::string problem = connect_at_once(candidate, address); !problem.empty()) return problem;
    const ssize_t sent = ::send(candidate, request_.data(), request_.size(), MSG_NOSIGNAL);
    return std::string(sent == static_cast<ssize_t>(request_.size()) ? "" : std::strerror(errno));
  };
  try {
    socket_ = connect_tcp(host_, port_, connect_and_ask);
    was_connected_ = true;
  } catch (const std::runtime_error& error) {
    disconnect(error.what());
  }
  return connected();
}

std::optional<std::string> WatchStream::take_line() {
  const auto end = bytes_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = bytes_.substr(0, end);
  bytes_.erase(0, end + 1);
  return line;
}

std::optional<std::string> WatchStream::next(Clock::time_point until) {
  for (;;) {
    if (auto line = take_line()) return line;
    if (!connected()) {
      if (Clock::now() < next_attempt_) {
        if (::poll(nullptr, 0, milliseconds_until(std::min(until, next_attempt_))) < 0) return std::nullopt;
        if (Clock::now() >= until) return std::nullopt;
        continue;
      }
      if (!connect()) continue;
    }
    pollfd readable{socket_.get(), POLLIN, 0};
    if (::poll(&readable, 1, milliseconds_until(until)) <= 0) return std::nullopt;
    std::array<char, 16384> chunk{};
    const ssize_t n = ::recv(socket_.get(), chunk.data(), chunk.size(), 0);
    if (n < 0 && errno == EINTR) return std::nullopt;
    if (n <= 0) {
      disconnect(n == 0 ? "the daemon closed the connection" : std::strerror(errno));
    } else if (bytes_.size() > kMaxLine) {
      disconnect("the peer is not navcald: it sends no lines");
    } else {
      bytes_.append(chunk.data(), static_cast<std::size_t>(n));
    }
  }
}

}  // namespace navcal::cli
