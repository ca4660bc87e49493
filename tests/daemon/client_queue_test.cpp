// SPDX-License-Identifier: Apache-2.0
#include "daemon/client_queue.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "daemon/line_reader.h"

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

TEST(LineReader, LinesDoNotDependOnHowTheyWereCut) {
  std::mt19937 random(5);
  const std::string text = "?POLL;\n\n?VERSION;\r\nlonger line with words\nlast";
  for (int round = 0; round < 500; ++round) {
    LineReader reader(64);
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t n = std::min<std::size_t>(text.size() - at, 1 + random() % 9);
      ASSERT_TRUE(reader.feed(text.substr(at, n), [&](std::string_view line) { lines.emplace_back(line); }));
      at += n;
    }
    const std::vector<std::string> expected{"?POLL;", "", "?VERSION;\r", "longer line with words"};
    EXPECT_EQ(lines, expected);
    EXPECT_EQ(reader.held(), "last");
  }
}

TEST(LineReader, RefusesALineBeyondItsBoundWhereverItIsCut) {
  for (const std::size_t cut : {1UL, 7UL, 100UL, 5000UL}) {
    LineReader reader(100);
    const std::string text = "ok\n" + std::string(101, 'x') + "\nnever\n";
    std::vector<std::string> lines;
    bool accepted = true;
    for (std::size_t at = 0; at < text.size(); at += cut) {
      accepted = reader.feed(std::string_view(text).substr(at, cut),
                             [&](std::string_view line) { lines.emplace_back(line); });
    }
    EXPECT_FALSE(accepted);
    EXPECT_EQ(lines, std::vector<std::string>{"ok"});
  }
}

}  // namespace
}  // namespace navcal::daemon
