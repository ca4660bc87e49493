// SPDX-License-Identifier: Apache-2.0
#include "base/line_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace navcal::base {
namespace {

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
    const std::vector<std::string> expected{"?POLL;", "", "?VERSION;", "longer line with words"};
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
}  // namespace navcal::base
