// SPDX-License-Identifier: Apache-2.0
#include "nav/depth_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace navcal::nav::test {
namespace {

constexpr double kFrame_s = 0.05;

TEST(DepthFilter, FollowsADiveThatNothingForetold) {
  DepthFilter filter({});
  filter.correct(0);
  for (int i = 1; i <= 600; ++i) {
    filter.advance(0, kFrame_s);
    filter.correct(0.3 * i * kFrame_s);
  }
  EXPECT_NEAR(*filter.depth_m(), 9, 0.001);
  EXPECT_NEAR(filter.sinking_m_s(), 0.3, 0.001);
}

TEST(DepthFilter, ComesBackWithoutOvershoot) {
  DepthFilter filter({});
  filter.correct(1);
  double greatest_m = 1;
  for (int i = 1; i <= 600; ++i) {
    filter.advance(0, kFrame_s);
    filter.correct(0);
    EXPECT_GT(*filter.depth_m(), -0.15) << "beyond by no more than the rate it learnt on its way";
    greatest_m = std::max(greatest_m, *filter.depth_m());
  }
  EXPECT_NEAR(*filter.depth_m(), 0, 0.001);
  EXPECT_EQ(greatest_m, 1);
}

TEST(DepthFilter, QuietensTheGauge) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.02);
  DepthFilter filter({});
  double square = 0;
  for (int i = 0; i < 20'000; ++i) {
    filter.advance(0, kFrame_s);
    filter.correct(2 + noise(random));
    if (i > 1000) square += std::pow(*filter.depth_m() - 2, 2);
  }
  EXPECT_LT(std::sqrt(square / 19'000), 0.25 * 0.02);
}

TEST(DepthFilter, AfterAPauseTheGaugeIsBelieved) {
  DepthFilter filter({});
  filter.correct(1);
  filter.advance(0.5, 10);
  filter.correct(40);
  EXPECT_EQ(*filter.depth_m(), 40);
}

TEST(DepthFilter, StatesTheErrorOfTheNewestReadingAndWhatCameSince) {
  DepthFilter filter({});
  EXPECT_FALSE(filter.std_m());
  filter.correct(1);
  EXPECT_FALSE(filter.std_m()) << "nothing is stated";
  filter.correct(1, 0.03);
  EXPECT_EQ(filter.std_m(), 0.03);
  filter.advance(0, 0.4);
  EXPECT_NEAR(*filter.std_m(), 0.05, 1e-12);
  filter.correct(1, 0.03);
  EXPECT_EQ(filter.std_m(), 0.03);
}

}  // namespace
}  // namespace navcal::nav::test
