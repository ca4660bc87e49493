// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace navcal::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kRetry = std::chrono::milliseconds(500);

}  // namespace

WatchStream::WatchStream(std::string host, std::string port, std::string_view request)
    : host_(std::move(host)), port_(std::move(port)), request_(request) {}

void WatchStream::disconnect(std::string problem) {
  socket_.reset();
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
    socket_.emplace(connect_tcp(host_, port_, connect_and_ask));
    was_connected_ = true;
  } catch (const std::runtime_error& error) {
    disconnect(error.what());
  }
  return connected();
}

std::optional<std::string> WatchStream::next(Clock::time_point until) {
  for (;;) {
    if (!connected()) {
      if (Clock::now() < next_attempt_) {
        if (::poll(nullptr, 0, milliseconds_until(std::min(until, next_attempt_))) < 0) return std::nullopt;
        if (Clock::now() >= until) return std::nullopt;
        continue;
      }
      if (!connect()) continue;
    }
    try {
      return socket_->next(until);
    } catch (const std::runtime_error& error) {
      disconnect(error.what());
    }
  }
}

}  // namespace navcal::cli
