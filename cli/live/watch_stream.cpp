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
/// The reader of a stream looks so often whether it should end.
constexpr auto kReadStep = std::chrono::milliseconds(200);
/// Lines that wait for their taker, a quarter of an hour of all reports; then the daemon waits.
constexpr std::size_t kMostWaiting_bytes = 256UL << 20;

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

ReadAhead::ReadAhead(WatchStream stream)
    : stream_(std::move(stream)), reader_([this](const std::stop_token& stop) { read(stop); }) {}

void ReadAhead::read(const std::stop_token& stop) {
  bool was_connected = true;
  while (!stop.stop_requested()) {
    auto line = stream_.next(Clock::now() + kReadStep);
    std::unique_lock lock(mutex_);
    if (line) {
      waiting_bytes_ += line->size();
      items_.push_back({std::move(line), true, {}});
    }
    if (stream_.connected() != was_connected) {
      was_connected = stream_.connected();
      items_.push_back({std::nullopt, was_connected, stream_.problem()});
    }
    changed_.notify_all();
    changed_.wait(lock, stop, [this] { return waiting_bytes_ < kMostWaiting_bytes; });
  }
}

std::optional<ReadAhead::Item> ReadAhead::next(Clock::time_point until) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_until(lock, until, [this] { return !items_.empty(); })) return std::nullopt;
  Item item = std::move(items_.front());
  items_.pop_front();
  if (item.line) waiting_bytes_ -= item.line->size();
  changed_.notify_all();
  return item;
}

}  // namespace navcal::cli
