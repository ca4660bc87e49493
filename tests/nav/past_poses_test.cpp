// SPDX-License-Identifier: Apache-2.0
#include "nav/past_poses.h"

#include <gtest/gtest.h>

#include "base/angles.h"

namespace navcal::nav::test {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

Pose pose(std::int64_t time_ms, double heading_rad) {
  Pose pose;
  pose.time_ns = time_ms * kMillisecond_ns;
  pose.heading_rad = heading_rad;
  pose.reckoned_m = {static_cast<double>(time_ms), 0};
  return pose;
}

TEST(PastPoses, RemembersNothingAtFirst) { EXPECT_FALSE(PastPoses().at(0)); }

TEST(PastPoses, IsLinearBetweenNeighboursAndALittleBeyond) {
  PastPoses past;
  for (int i = 0; i < 10; ++i) past.push(pose(100 + 50 * i, 0.1 * i));
  for (const int ms : {100, 120, 149, 150, 333, 550, 600, 700}) {
    const auto found = past.at(ms * kMillisecond_ns);
    ASSERT_TRUE(found) << ms;
    EXPECT_NEAR(found->heading_rad, 0.002 * (ms - 100), 1e-12) << ms;
    EXPECT_NEAR(found->reckoned_m.x(), ms, 1e-9) << ms;
  }
  EXPECT_FALSE(past.at(99 * kMillisecond_ns));
  EXPECT_FALSE(past.at(751 * kMillisecond_ns));
}

TEST(PastPoses, GoesTheShortWayRoundTheCircle) {
  PastPoses past;
  past.push(pose(0, 3.1));
  past.push(pose(100, -3.1));
  EXPECT_NEAR(std::abs(base::wrapped(past.at(50 * kMillisecond_ns)->heading_rad)), std::numbers::pi, 1e-9);
}

TEST(PastPoses, ReachesBackFiveSecondsHoweverOftenItIsTold) {
  for (const int period_ms : {1, 7, 40, 50}) {
    PastPoses past;
    for (int t_ms = 0; t_ms <= 20'000; t_ms += period_ms) past.push(pose(t_ms, 1e-4 * t_ms));
    const auto found = past.at((20'000 - 4'900) * kMillisecond_ns);
    ASSERT_TRUE(found) << period_ms;
    EXPECT_NEAR(found->heading_rad, 1.51, 1e-9) << period_ms;
    EXPECT_FALSE(past.at(10'000 * kMillisecond_ns)) << period_ms;
  }
}

TEST(PastPoses, ACorrectionIsOneOfThePastToo) {
  PastPoses past;
  past.push(pose(0, 1));
  past.push(pose(50, 2));
  past.correct({0.1, 0.2, 0.3});
  past.push(pose(100, 2.3));
  const auto found = past.at(25 * kMillisecond_ns);
  EXPECT_NEAR(found->roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(found->pitch_rad, 0.2, 1e-12);
  EXPECT_NEAR(found->heading_rad, 1.8, 1e-12);
  // A pose added after a correction contains the correction already.
  EXPECT_NEAR(past.at(100 * kMillisecond_ns)->heading_rad, 2.3, 1e-12);
  EXPECT_NEAR(past.at(50 * kMillisecond_ns)->heading_rad, 2.3, 1e-12);
}

}  // namespace
}  // namespace navcal::nav::test
