// SPDX-License-Identifier: Apache-2.0
#include "pipeline/floor_watch.h"

#include <gtest/gtest.h>

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kFloorSecond_ns = 1'000'000'000;

config::NavigationSettings two_metres() {
  config::NavigationSettings settings;
  settings.min_altitude_m = 2;
  settings.floor_warning_s = 3;
  return settings;
}

TEST(FloorWatch, NothingIsNearWithoutALimit) {
  FloorWatch watch{config::NavigationSettings()};
  EXPECT_FALSE(watch.take(0, {0.1, 0.1, -1, 0.1}));
  EXPECT_FALSE(watch.is_near());
}

TEST(FloorWatch, TheFloorIsNearBelowTheLimit) {
  FloorWatch watch{two_metres()};
  EXPECT_FALSE(watch.take(0, {2.1, 0.1, 0, 0.1}));
  EXPECT_TRUE(watch.take(kFloorSecond_ns, {1.9, 0.1, 0, 0.1}));
  EXPECT_TRUE(watch.is_near());
}

TEST(FloorWatch, TheFloorIsNearWhenItWillBe) {
  FloorWatch watch{two_metres()};
  EXPECT_FALSE(watch.take(0, {4, 0.1, -0.5, 0.1}));                // 2.5 m in three seconds
  EXPECT_FALSE(watch.take(kFloorSecond_ns, {4, 0.1, -0.8, 0.5}));  // the rate is not certain
  EXPECT_TRUE(watch.take(2 * kFloorSecond_ns, {4, 0.1, -0.8, 0.1}));
}

TEST(FloorWatch, TheFloorIsFarAgainAfterTwoSecondsAboveTheHysteresis) {
  FloorWatch watch{two_metres()};
  EXPECT_TRUE(watch.take(0, {1.9, 0.1, 0, 0.1}));
  EXPECT_FALSE(watch.take(kFloorSecond_ns, {2.2, 0.1, 0, 0.1}));
  EXPECT_FALSE(watch.take(2 * kFloorSecond_ns, {2.4, 0.1, 0, 0.1}));
  EXPECT_TRUE(watch.take(3 * kFloorSecond_ns, {2.4, 0.1, 0, 0.1}));
  EXPECT_FALSE(watch.is_near());
}

}  // namespace
}  // namespace navcal::pipeline
