// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/quiet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

constexpr double kQuietPeriod_s = 0.02;

MotionChannel gyro(const Series& series) { return {"imu.rate_z", "deg/s", &series, 0.05, {}}; }

/// Noise with the motion added between two times.
template <class Motion>
Series moved(double duration_s, double std, double from_s, double to_s, Motion motion, double filter = 0) {
  noise_test::MadeNoise noise(11);
  const auto count = static_cast<std::size_t>(duration_s / kQuietPeriod_s);
  Series series = noise_test::series_of(noise.filtered(count, std, filter), kQuietPeriod_s);
  for (std::size_t i = 0; i < count; ++i) {
    if (series.time_s[i] >= from_s && series.time_s[i] < to_s) series.values[i] += motion(series.time_s[i]);
  }
  return series;
}

double sway(double time_s) { return 2 * std::sin(2 * std::numbers::pi * 0.3 * time_s); }

TEST(QuietParts, ARecordingAtRestIsOnePart) {
  for (const double filter : {0.0, 0.5, 0.8}) {
    const Series series = moved(600, 0.1, 0, 0, sway, filter);
    const auto parts = quiet_parts({gyro(series)}, 600);
    ASSERT_EQ(parts.intervals.size(), 1U) << filter;
    EXPECT_EQ(parts.intervals[0].from_s, 0);
    EXPECT_EQ(parts.intervals[0].to_s, 600);
    EXPECT_FALSE(parts.quietest);
  }
}

TEST(QuietParts, MotionInTheMiddleLeavesThePartsAtRest) {
  const Series series = moved(300, 0.1, 120.3, 180.7, sway);
  const auto parts = quiet_parts({gyro(series)}, 300);
  ASSERT_EQ(parts.intervals.size(), 2U);
  EXPECT_EQ(parts.intervals[0].from_s, 0);
  EXPECT_LE(parts.intervals[0].to_s, 120.3);
  EXPECT_GE(parts.intervals[0].to_s, 117);
  EXPECT_GE(parts.intervals[1].from_s, 180.7);
  EXPECT_LE(parts.intervals[1].from_s, 185);
  EXPECT_EQ(parts.intervals[1].to_s, 300);
}

TEST(QuietParts, MotionAllTheTimeIsNoRestAndTheNumberSaysWhy) {
  const Series series = moved(300, 0.1, 0, 300, sway);
  const auto parts = quiet_parts({gyro(series)}, 300);
  EXPECT_TRUE(parts.intervals.empty());
  ASSERT_TRUE(parts.quietest);
  EXPECT_EQ(parts.quietest->channel, "imu.rate_z");
  EXPECT_NEAR(parts.quietest->value, 2 / std::sqrt(2.0), 0.7);
  EXPECT_LT(parts.quietest->limit, 0.2);
}

TEST(QuietParts, AnotherChannelCanShowTheMotion) {
  const Series still = moved(300, 0.1, 0, 0, sway);
  const Series turned = moved(300, 0.3, 100, 200, [](double time_s) { return (time_s - 100) * 1.0; });
  const auto parts = quiet_parts({gyro(still), {"compass.heading", "deg", &turned, 0.2, {}}}, 300);
  ASSERT_EQ(parts.intervals.size(), 2U);
  EXPECT_LE(parts.intervals[0].to_s, 101);
  EXPECT_GE(parts.intervals[1].from_s, 199);
}

TEST(QuietParts, AVibrationInAPartEndsIt) {
  noise_test::MadeNoise more(4);
  const Series series = moved(300, 0.1, 200, 300, [&](double) { return more.white(1, 0.5)[0]; });
  const auto parts = quiet_parts({gyro(series)}, 300);
  ASSERT_EQ(parts.intervals.size(), 1U);
  EXPECT_LE(parts.intervals[0].to_s, 200);
}

TEST(QuietParts, AMeanBeyondItsLimitIsMotion) {
  const Series shaft = noise_test::series_of(std::vector<double>(1000, 700.0), 0.1);
  const auto parts = quiet_parts({{"motor.rpm", "rpm", &shaft, 1, 1}}, 100);
  EXPECT_TRUE(parts.intervals.empty());
  ASSERT_TRUE(parts.quietest);
  EXPECT_EQ(parts.quietest->what, "has a mean of");
  EXPECT_EQ(parts.quietest->value, 700);
}

TEST(QuietParts, ShortRecordingsAndNoChannelsHaveNone) {
  const Series series = moved(5, 0.1, 0, 0, sway);
  EXPECT_TRUE(quiet_parts({gyro(series)}, 5).intervals.empty());
  EXPECT_TRUE(quiet_parts({}, 1000).intervals.empty());
  EXPECT_FALSE(quiet_parts({}, 1000).quietest);
  EXPECT_TRUE(quiet_parts({}, 0).intervals.empty());
}

TEST(QuietParts, ASlowChannelIsJudgedByItsReadings) {
  noise_test::MadeNoise noise(1);
  Series compass = noise_test::series_of(noise.white(600, 0.3), 1);
  const auto parts = quiet_parts({{"compass.heading", "deg", &compass, 0.2, {}}}, 600);
  double length_s = 0;
  for (const auto& interval : parts.intervals) length_s += interval.length_s();
  EXPECT_GT(length_s, 550);
}

}  // namespace
}  // namespace navcal::analysis
