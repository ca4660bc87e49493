// SPDX-License-Identifier: Apache-2.0
#include "control/shaper.h"

#include <gtest/gtest.h>

#include <cmath>

namespace navcal::control {
namespace {

config::CommandSettings with_slew(double rpm_s, double fin_deg_s) {
  config::CommandSettings settings;
  settings.slew_rpm_s = rpm_s;
  settings.slew_fin_deg_s = fin_deg_s;
  return settings;
}

TEST(Shaper, RampsAreStraightAndEndExactly) {
  Shaper shaper(with_slew(1000, 100));
  shaper.jump(0, {});
  shaper.aim({500, {-10, 25, 0}});
  std::int64_t t_ns = 0;
  for (int step = 1; !shaper.arrived(); ++step) {
    ASSERT_LE(step, 10);
    ASSERT_EQ(shaper.next_ns(), t_ns + Shaper::kStep_ns);
    t_ns += Shaper::kStep_ns;
    const Order& now = shaper.step(t_ns);
    EXPECT_DOUBLE_EQ(now.shaft_rpm, std::min(500.0, 50.0 * step));
    EXPECT_DOUBLE_EQ(now.fins_deg[0], std::max(-10.0, -5.0 * step));
    EXPECT_DOUBLE_EQ(now.fins_deg[1], std::min(25.0, 5.0 * step));
  }
  EXPECT_EQ(t_ns, 10 * Shaper::kStep_ns);
  EXPECT_EQ(shaper.next_ns(), kNever_ns);
}

TEST(Shaper, APauseIsNotMadeUpFor) {
  Shaper shaper(with_slew(1000, 100));
  shaper.jump(0, {});
  shaper.aim({1000, {}});
  EXPECT_DOUBLE_EQ(shaper.step(60'000'000'000).shaft_rpm, 50);
}

TEST(Shaper, NoRateTimesPassedBackwardsDoNothing) {
  Shaper shaper(with_slew(1000, 100));
  shaper.jump(1'000'000'000, {100, {}});
  shaper.aim({1000, {}});
  EXPECT_DOUBLE_EQ(shaper.step(0).shaft_rpm, 100);
}

TEST(Shaper, ARampBeginsAtTheLineSentWithoutOneHoweverSlowItIs) {
  Shaper shaper(with_slew(1, 1));
  shaper.jump(1'000'000'000, {100, {}});
  shaper.aim({200, {}});
  EXPECT_DOUBLE_EQ(shaper.step(1'010'000'000).shaft_rpm, 100.01);
}

TEST(Shaper, ZeroIsAtOnce) {
  Shaper shaper(with_slew(0, 0));
  shaper.jump(0, {});
  shaper.aim({-700, {25, -25, 1}});
  EXPECT_EQ(shaper.step(1), (Order{-700, {25, -25, 1}}));
  EXPECT_TRUE(shaper.arrived());
}

}  // namespace
}  // namespace navcal::control
