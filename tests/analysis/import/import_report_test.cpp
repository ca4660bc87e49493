// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/import_report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace navcal::analysis {
namespace {

TEST(ImportReport, OfManyChannelsTheMostFrequentAreListed) {
  ImportReport report;
  for (int i = 0; i < 2000; ++i) report.left["sensor " + std::to_string(i)] = 1;
  report.left["often"] = 7;
  report.taken[{"m_depth", "depth"}].messages = 3;
  const std::string text = to_text(report);
  EXPECT_NE(text.find("\noften "), std::string::npos) << text;
  EXPECT_NE(text.find("\nand 1961 more of at most 1 each; --json has all\n"), std::string::npos) << text;
  EXPECT_LT(std::ranges::count(text, '\n'), 60);
  EXPECT_NE(to_json(report).find("sensor 1999"), std::string::npos);
}

}  // namespace
}  // namespace navcal::analysis
