// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>

#include "report/plot_axes.h"

namespace navcal::cli {
namespace {

TEST(HeadingAxis, ACourseAboutNorthStaysTogether) {
  std::vector<double> headings_deg;
  for (int i = 0; i < 100; ++i) headings_deg.push_back(std::fmod(360 + 8 * std::sin(i), 360));
  const report::HeadingAxis heading(headings_deg);
  for (const double value : headings_deg) {
    EXPECT_NEAR(heading(value), std::remainder(value, 360), 1e-9);
  }
}

TEST(HeadingAxis, IsCutWhereNobodyPointed) {
  // North, east, west and south-east: cut between south-east and west.
  const report::HeadingAxis heading({0, 1, 359, 90, 91, 269, 270, 135});
  const auto axis = heading.axis("heading");
  EXPECT_EQ(axis.range.length(), 360);
  const double cut_deg = std::fmod(axis.range.least + 720, 360);
  EXPECT_GT(cut_deg, 140);
  EXPECT_LT(cut_deg, 265);
  for (const double value : {0.0, 359.9, 90.0, 270.0, 135.0, -720.0}) {
    EXPECT_TRUE(axis.range.contains(heading(value))) << value;
    EXPECT_NEAR(std::remainder(heading(value) - value, 360), 0, 1e-9);
  }
}

TEST(HeadingAxis, MarksAreTheEightWinds) {
  const auto axis = report::HeadingAxis({}).axis("heading");
  ASSERT_EQ(axis.ticks.size(), 8U);
  const auto text_at = [&](double heading_deg) {
    for (const auto& tick : axis.ticks) {
      if (std::abs(std::remainder(tick.value - heading_deg, 360)) < 1e-9) return tick.text;
    }
    return std::string();
  };
  EXPECT_EQ(text_at(0), "N");
  EXPECT_EQ(text_at(90), "E");
  EXPECT_EQ(text_at(225), "SW");
}

TEST(EarlyTimeAxis, TheFirstMinuteHasRoom) {
  const report::EarlyTimeAxis time({100, 110, 3700});
  const auto axis = time.axis();
  EXPECT_EQ(time(100), 0);
  EXPECT_NEAR(time(3700), axis.range.most, 1e-9);
  EXPECT_GT(time(160) / axis.range.most, 0.2) << "a minute of an hour";
  ASSERT_GT(axis.ticks.size(), 4U);
  EXPECT_EQ(axis.ticks.front().text, "0");
  for (std::size_t i = 1; i < axis.ticks.size(); ++i) EXPECT_GT(axis.ticks[i].value, axis.ticks[i - 1].value);
  EXPECT_TRUE(report::EarlyTimeAxis({}).axis().range.length() > 0);
}

TEST(EarlyTimeAxis, EstimatesThatBeginLateHaveTheirOwnFirstMinute) {
  const report::EarlyTimeAxis time({303, 400});
  EXPECT_EQ(time(303), 0);
  EXPECT_EQ(time.axis().label, "time since the first estimate, 5 min 3 s from the beginning");
  EXPECT_EQ(report::EarlyTimeAxis({5, 400}).axis().label,
            "time since the first estimate, 5.0 s from the beginning");
  EXPECT_EQ(report::EarlyTimeAxis({0, 400}).axis().label, "time since the first estimate");
}

}  // namespace
}  // namespace navcal::cli
