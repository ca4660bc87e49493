// SPDX-License-Identifier: Apache-2.0
#include "nav/altitude_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace navcal::nav {
namespace {

constexpr std::int64_t kPing_ns = 200'000'000;

TEST(AltitudeFilter, NothingIsKnownBeforeTheFirstReadingAndSoonAfterTheLast) {
  AltitudeFilter filter{AltitudeOptions()};
  EXPECT_FALSE(filter.at(0));
  EXPECT_TRUE(filter.take(0, 5, 0, 0));
  EXPECT_TRUE(filter.at(2'000'000'000));
  EXPECT_FALSE(filter.at(2'000'000'001));
}

TEST(AltitudeFilter, SlantRangeBecomesTheHeightStraightDown) {
  AltitudeFilter filter{AltitudeOptions()};
  const double pitch_rad = 0.3, roll_rad = -0.2;
  const double range_m = 10 / (std::cos(pitch_rad) * std::cos(roll_rad));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(filter.take(i * kPing_ns, range_m, pitch_rad, roll_rad));
  EXPECT_NEAR(filter.at(19 * kPing_ns)->altitude_m, 10, 1e-9);
}

TEST(AltitudeFilter, FollowsAFloorThatRises) {
  AltitudeFilter filter{AltitudeOptions()};
  for (int i = 0; i < 100; ++i) (void)filter.take(i * kPing_ns, 20 - 0.5 * i * 0.2, 0, 0);
  const auto altitude = filter.at(99 * kPing_ns);
  EXPECT_NEAR(altitude->altitude_m, 20 - 0.5 * 99 * 0.2, 0.01);
  EXPECT_NEAR(altitude->rate_m_s, -0.5, 0.01);
}

TEST(AltitudeFilter, OneFishIsLeftOutAndAStepIsBelievedAfterThree) {
  AltitudeFilter filter{AltitudeOptions()};
  std::int64_t t_ns = 0;
  for (int i = 0; i < 50; ++i) (void)filter.take(t_ns += kPing_ns, 10, 0, 0);
  EXPECT_FALSE(filter.take(t_ns += kPing_ns, 3, 0, 0));
  EXPECT_TRUE(filter.take(t_ns += kPing_ns, 10, 0, 0));
  EXPECT_NEAR(filter.at(t_ns)->altitude_m, 10, 0.05);
  EXPECT_FALSE(filter.take(t_ns += kPing_ns, 3, 0, 0));
  EXPECT_FALSE(filter.take(t_ns += kPing_ns, 3, 0, 0));
  EXPECT_TRUE(filter.take(t_ns += kPing_ns, 3, 0, 0));
  EXPECT_NEAR(filter.at(t_ns)->altitude_m, 3, 0.05);
}

TEST(AltitudeFilter, WhatCannotBeIsLeftOut) {
  AltitudeFilter filter{AltitudeOptions()};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(filter.take(0, nan, 0, 0));
  EXPECT_FALSE(filter.take(0, -1, 0, 0));
  EXPECT_FALSE(filter.take(0, 101, 0, 0));
  EXPECT_FALSE(filter.take(0, 5, nan, 0));
  EXPECT_FALSE(filter.take(0, 5, 1.6, 0));
  EXPECT_TRUE(filter.take(kPing_ns, 5, 0, 0));
  EXPECT_FALSE(filter.take(kPing_ns, 5, 0, 0));
  EXPECT_FALSE(filter.take(0, 5, 0, 0));
}

/// 50 runs over a floor that waves, 5 readings a second with the configured noise, 2 % lost.
TEST(AltitudeFilter, ErrorsLieWithinTwoStatedStandardDeviations) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  int within = 0, all = 0;
  double square_m2 = 0;
  for (int run = 0; run < 50; ++run) {
    AltitudeFilter filter{AltitudeOptions()};
    const double wave_s = 20 + 40 * uniform(random), height_m = 1 + uniform(random);
    const auto truth = [&](double t_s) { return 10 + height_m * std::sin(6.283 * t_s / wave_s); };
    for (int i = 0; i < 600; ++i) {
      const double t_s = 0.2 * i;
      if (uniform(random) > 0.02) (void)filter.take(i * kPing_ns, truth(t_s) + 0.1 * normal(random), 0, 0);
      if (i < 50) continue;
      const auto altitude = filter.at(i * kPing_ns);
      ASSERT_TRUE(altitude);
      const double error_m = altitude->altitude_m - truth(t_s);
      square_m2 += error_m * error_m;
      within += std::abs(error_m) <= 2 * altitude->std_m ? 1 : 0;
      ++all;
    }
  }
  RecordProperty("within_two_std_permille", 1000 * within / all);
  RecordProperty("rms_mm", static_cast<int>(1000 * std::sqrt(square_m2 / all)));
  EXPECT_GE(within, 0.9 * all);
}

}  // namespace
}  // namespace navcal::nav
