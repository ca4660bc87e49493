// SPDX-License-Identifier: Apache-2.0
#include "daemon/client_queue.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::daemon {
namespace {

TEST(ClientQueue, WhatComesOutIsWholeReportsInOrderAndTheRestIsCounted) {
  std::mt19937 random(4);
  constexpr std::size_t kCapacity = 1000;
  ClientQueue queue(kCapacity);
  std::string out, expected;
  std::uint64_t dropped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string report = std::to_string(i) + std::string(random() % 120, '.') + "\n";
    if (queue.push(report)) {
      expected += report;
    } else {
      ++dropped;
    }
    const std::size_t n = std::min<std::size_t>(queue.size(), random() % 90);
    out += queue.front().substr(0, n);
    queue.pop(n);
    EXPECT_LE(queue.size(), kCapacity);
    EXPECT_LE(queue.allocated(), kCapacity + 1);
  }
  out += queue.front();
  EXPECT_EQ(out, expected);
  EXPECT_EQ(queue.dropped(), dropped);
  EXPECT_GT(dropped, 0U);
}

TEST(ClientQueue, ABegunReportIsFinishedEvenBeyondTheBound) {
  ClientQueue queue(10);
  queue.push_rest("the end of a long report\n");
  EXPECT_FALSE(queue.push("x\n"));
  EXPECT_EQ(queue.front(), "the end of a long report\n");
  queue.pop(queue.size());
  EXPECT_TRUE(queue.push("x\n"));
  EXPECT_EQ(queue.dropped(), 1U);
}

}  // namespace
}  // namespace navcal::daemon
