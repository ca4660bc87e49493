// SPDX-License-Identifier: Apache-2.0
#include "daemon/lazy_timer.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>

namespace navcal::daemon {
namespace {

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1); }

TEST(LazyTimer, RingsOnceAtTheEarliestDeadline) {
  boost::asio::io_context io;
  int rings = 0;
  LazyTimer timer(io.get_executor(), [&] { ++rings; });
  timer.arm(now_ns() + 3'600'000'000'000);
  timer.arm(now_ns());
  io.run();
  EXPECT_EQ(rings, 1);
}

TEST(LazyTimer, StoppedInTheTurnOfTheLoopInWhichItEndsItDoesNotRing) {
  boost::asio::io_context io;
  LazyTimer* to_stop = nullptr;
  // Rings first of two that have both ended: the other is on its way by then.
  LazyTimer first(io.get_executor(), [&] { to_stop->stop(); });
  LazyTimer second(io.get_executor(), [] { ADD_FAILURE() << "it was stopped"; });
  to_stop = &second;
  const std::int64_t now = now_ns();
  first.arm(now - 2);
  second.arm(now - 1);
  io.run();
}

}  // namespace
}  // namespace navcal::daemon
