// SPDX-License-Identifier: Apache-2.0
#include "daemon/alarms.h"

#include <gtest/gtest.h>

#include "daemon/latency_histogram.h"

namespace navcal::daemon {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Alarms, ALeakIsOneAlarmHoweverItSloshes) {
  Alarms alarms;
  std::size_t changes = 0;
  for (int i = 0; i < 200; ++i) {
    instruments::ImuSample imu;
    imu.card = {.leak_aft = i % 3 == 0};
    changes += alarms.update(2, imu, i * kSecond / 20).size();
  }
  EXPECT_EQ(changes, 1U);
  ASSERT_EQ(alarms.standing().size(), 1U);
  EXPECT_EQ(alarms.standing()[0].alarm, Alarm::leak_aft);
  EXPECT_EQ(alarms.standing()[0].port, 2);
}

TEST(Alarms, AnAlarmIsClearedAfterItsTimeAndNotBefore) {
  Alarms alarms;
  instruments::ImuSample imu;
  imu.card = {.low_supply = true};
  ASSERT_EQ(alarms.update(0, imu, 0).size(), 1U);
  imu.card = instruments::CardState{};
  EXPECT_TRUE(alarms.update(0, imu, Alarms::kClear_ns - 1).empty());
  const auto& cleared = alarms.update(0, imu, Alarms::kClear_ns);
  ASSERT_EQ(cleared.size(), 1U);
  EXPECT_FALSE(cleared[0].raised);
  EXPECT_TRUE(alarms.standing().empty());
}

TEST(Alarms, LeaksStandFirstAndCardsApart) {
  Alarms alarms;
  instruments::ImuSample imu;
  imu.over_range = true;
  imu.card = {.low_supply = true};
  ASSERT_EQ(alarms.update(0, imu, 0).size(), 2U);
  instruments::ImuSample other;
  other.card = {.leak_forward = true};
  ASSERT_EQ(alarms.update(1, other, 1).size(), 1U);
  ASSERT_EQ(alarms.standing().size(), 3U);
  EXPECT_EQ(alarms.standing()[0].alarm, Alarm::leak_forward);
  EXPECT_EQ(alarms.standing()[0].port, 1);
}

TEST(Alarms, WhatSomebodyElseJudgesStandsBesideTheCards) {
  Alarms alarms;
  EXPECT_FALSE(alarms.set(3, Alarm::command_not_echoed, false, 0));
  EXPECT_TRUE(alarms.set(3, Alarm::command_not_echoed, true, 1));
  EXPECT_FALSE(alarms.set(3, Alarm::command_not_echoed, true, 2));
  instruments::ImuSample leaking;
  leaking.card = {.leak_aft = true};
  EXPECT_EQ(alarms.update(1, leaking, 3).size(), 1U);
  ASSERT_EQ(alarms.standing().size(), 2U);
  EXPECT_EQ(alarms.standing()[0].alarm, Alarm::leak_aft) << "leaks first";
  EXPECT_TRUE(alarms.update(3, {}, 10 * Alarms::kClear_ns).empty()) << "a card's sample does not end it";
  EXPECT_TRUE(alarms.set(3, Alarm::command_not_echoed, false, 4));
  EXPECT_EQ(alarms.standing().size(), 1U);
}

TEST(LatencyHistogram, EveryLatencyIsInTheBucketOfItsPowerOfTwo) {
  for (std::size_t bucket = 1; bucket + 1 < LatencyHistogram::kBuckets; ++bucket) {
    LatencyHistogram histogram;
    histogram.add((std::int64_t{1} << (bucket - 1)) * 1000);
    histogram.add((std::int64_t{1} << bucket) * 1000 - 1);
    EXPECT_EQ(histogram.buckets()[bucket], 2U);
  }
}

TEST(LatencyHistogram, ExtremesStayInside) {
  LatencyHistogram histogram;
  histogram.add(-5);
  histogram.add(0);
  histogram.add(INT64_MAX);
  EXPECT_EQ(histogram.buckets().front(), 2U);
  EXPECT_EQ(histogram.buckets().back(), 1U);
}

}  // namespace
}  // namespace navcal::daemon
