// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include "tests/calib/delay/delay_motion.h"

namespace navcal::calib {
namespace {

using test::DelayMotion;
using Random = std::mt19937_64;

DelayMotion quiet() {
  DelayMotion motion;
  motion.field_noise_uT = motion.rate_noise_rad_s = motion.tilt_noise_rad = 0;
  motion.tilt_lag_s = 0.05;  // of no bearing on the field, and quick to simulate
  return motion;
}

std::string saved(FieldDelay& delay) {
  Archive archive;
  delay.archive(archive);
  return archive.bytes();
}

TEST(FieldDelay, FindsDelayAndHardIronWhateverTheBias) {
  for (const double delay_s : {-0.02, 0.0, 0.012, 0.04}) {
    auto motion = quiet();
    motion.delay_s = delay_s;
    FieldDelay delay;
    Random random(1);
    test::feed(delay, motion, 0, 60, random);
    EXPECT_NEAR(delay.estimate().delay_s, delay_s, 5e-4);
    EXPECT_LT((delay.hard_iron_uT() - motion.hard_iron_uT).head<2>().norm(), 0.3)
        << delay.hard_iron_uT().transpose();
  }
}

TEST(FieldDelay, StandardErrorIsHonestAndTwoMillisecondsAfterAMinute) {
  auto motion = quiet();
  motion.field_noise_uT = 0.15;
  motion.rate_noise_rad_s = 0.0017;
  int within = 0;
  for (unsigned run = 1; run <= 60; ++run) {
    FieldDelay::Parameters parameters;
    parameters.field_noise_uT = 0.15;
    parameters.walk_uT_sqrt_s = 0.05;
    FieldDelay delay(parameters);
    Random random(run);
    test::feed(delay, motion, 0, 60, random);
    const auto estimate = delay.estimate();
    EXPECT_LT(estimate.std_s, 0.002);
    within += std::abs(estimate.delay_s - motion.delay_s) <= 2 * estimate.std_s ? 1 : 0;
  }
  EXPECT_GE(within, 50);  // 95.4 % of 60: lower 99.9 % binomial limit
}

TEST(FieldDelay, StraightAheadItDoesNotClaimToKnow) {
  auto motion = quiet();
  motion.turn = 0;
  motion.field_noise_uT = 0.15;
  motion.rate_noise_rad_s = 0.0017;
  FieldDelay delay;
  Random random(1);
  test::feed(delay, motion, 0, 120, random);
  EXPECT_GT(delay.estimate().std_s, 0.002);
}

TEST(FieldDelay, AMagnetThatComesToStayDoesNotSpoilIt) {
  auto before = quiet(), after = quiet();
  after.hard_iron_uT += Eigen::Vector3d(-1.5, -0.5, -13.6);
  FieldDelay delay;
  Random random(1);
  test::feed(delay, before, 0, 45, random);
  test::feed(delay, after, 45, 100, random);
  EXPECT_EQ(delay.field_steps(), 1U);
  EXPECT_NEAR(delay.estimate().delay_s, 0.012, 1e-3);
  EXPECT_LT((delay.hard_iron_uT() - after.hard_iron_uT).head<2>().norm(), 0.5);
}

TEST(FieldDelay, GapsAndBadReadingsDoNotSpoilIt) {
  const auto motion = quiet();
  FieldDelay delay;
  Random random(1);
  for (int k = 0; k < 20 * 90; ++k) {
    const double t = k / 20.0;
    if (k % 400 > 380) continue;  // a gap of a second
    auto rate = motion.rate(t, random);
    auto compass = motion.compass(t + 0.02, random);
    if (k % 100 == 7) rate.rate_rad_s.x() = std::numeric_limits<double>::quiet_NaN();
    if (k % 150 == 11) rate.saturated = true;
    if (k % 90 == 4) compass.field_body_uT->y() = std::numeric_limits<double>::infinity();
    if (k % 130 == 8) *compass.field_body_uT *= 3;  // a spike
    if (k % 70 == 2) {
      compass.faulty = true;
      compass.field_body_uT->setZero();
    }
    delay.update(rate);
    if (k % 2 == 0) delay.update(compass);
    if (k % 110 == 9) delay.update(motion.rate(t - 3, random));  // a reversed stamp
  }
  EXPECT_NEAR(delay.estimate().delay_s, 0.012, 2e-3);
}

TEST(FieldDelay, SavedAndRestoredItGoesOnBitForBit) {
  DelayMotion motion = quiet();
  FieldDelay whole, first;
  Random random(5), same(5);
  test::feed(whole, motion, 0, 40, random);
  test::feed(first, motion, 0, 20, same);
  const std::string bytes = saved(first);
  FieldDelay second;
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  test::feed(second, motion, 20, 40, same);
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
