// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

namespace navcal::daemon {

/// A timer for deadlines that are pushed back with every record: it is set only when a deadline comes to lie
/// before the one it waits for, so a record costs no system call. It may therefore ring early; who is called looks
/// at the clock and sets it again.
class LazyTimer {
 public:
  static constexpr std::int64_t kNever = INT64_MAX;

  LazyTimer(const boost::asio::any_io_executor& executor, std::function<void()> ring)
      : timer_(executor), ring_(std::move(ring)) {}

  /// `deadline_ns` on the monotonic clock.
  void arm(std::int64_t deadline_ns) {
    if (deadline_ns >= armed_ns_) return;
    armed_ns_ = deadline_ns;
    const std::uint64_t wait = ++waits_;
    timer_.expires_at(std::chrono::steady_clock::time_point(std::chrono::nanoseconds(deadline_ns)));
    timer_.async_wait([this, wait](boost::system::error_code error) {
      // A wait that ended in the same turn of the loop as stop() was called is no longer to be cancelled.
      if (error || wait != waits_) return;
      armed_ns_ = kNever;
      ring_();
    });
  }
  void stop() {
    ++waits_;
    timer_.cancel();
    armed_ns_ = kNever;
  }

 private:
  boost::asio::steady_timer timer_;
  std::function<void()> ring_;
  std::int64_t armed_ns_ = kNever;
  std::uint64_t waits_ = 0;  ///< the newest one counts
};

}  // namespace navcal::daemon
