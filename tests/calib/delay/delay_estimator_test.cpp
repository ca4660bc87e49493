// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_estimator.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/calib/delay/delay_motion.h"

namespace navcal::calib {
namespace {

using test::DelayMotion;
using Random = std::mt19937_64;

TEST(DelayEstimator, AMinuteOfTurnsWithARealisticCompass) {
  // Noise, tilt through the fluid's lag, hard iron and an uncalibrated gyro.
  const DelayMotion motion;
  DelayEstimator::Parameters parameters;
  parameters.field.field_noise_uT = 0.15;
  parameters.field.walk_uT_sqrt_s = 0.05;
  int by_field = 0, by_heading = 0;
  const int runs = 10;
  for (unsigned run = 1; run <= runs; ++run) {
    DelayEstimator delay(parameters);
    Random random(run);
    test::feed(delay, motion, 0, 60, random);
    EXPECT_LT(delay.compass().std_s, 0.002);
    EXPECT_TRUE(delay.compass_judgement().accepted);
    const Delay field = delay.field().estimate(), heading = delay.heading().estimate();
    by_field += std::abs(field.delay_s - motion.delay_s) <= 2 * field.std_s ? 1 : 0;
    by_heading += std::abs(heading.delay_s - motion.delay_s) <= 2 * heading.std_s ? 1 : 0;
  }
  EXPECT_GE(by_field, 7);  // lower 99.9 % binomial limit
  EXPECT_GE(by_heading, 7);
}

TEST(DelayEstimator, StraightAheadItRefusesAndSaysWhatIsMissing) {
  DelayMotion motion;
  motion.turn = 0;
  DelayEstimator delay;
  Random random(1);
  test::feed(delay, motion, 0, 30, random);
  const Judgement judgement = delay.compass_judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_EQ(judgement.reason, "the rate of turn has hardly changed: a delay does not show");
  EXPECT_FALSE(judgement.manoeuvre.empty());
  EXPECT_FALSE(delay.course_judgement().accepted);
}

TEST(DelayEstimator, BeforeAnyReadingNothingIsKnown) {
  const DelayEstimator delay;
  EXPECT_TRUE(std::isinf(delay.compass().std_s));
  EXPECT_FALSE(delay.compass_judgement().accepted);
  EXPECT_EQ(delay.compass_judgement().samples, 0U);
}

TEST(DelayEstimator, SavedAndRestoredItGoesOnBitForBit) {
  const auto saved = [](DelayEstimator& delay) {
    Archive archive;
    delay.archive(archive);
    return archive.bytes();
  };
  const DelayMotion motion;
  DelayEstimator whole, first;
  Random random(5), same(5);
  test::feed(whole, motion, 0, 20, random);
  test::feed(first, motion, 0, 10, same);
  const std::string bytes = saved(first);
  DelayEstimator second;
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  test::feed(second, motion, 10, 20, same);
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
