// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/gyro_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace navcal::calib {
namespace {

RateReading reading(int i, double offset_rad_s, double noise_rad_s, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  RateReading both;
  both.time_s = 0.05 * i;
  const double rate = 0.5 * std::sin(0.2 * both.time_s);
  both.rate_rad_s.z() = rate + offset_rad_s + noise_rad_s * normal(random);
  both.yaw_rate_b_rad_s = rate + noise_rad_s * normal(random);
  return both;
}

TEST(GyroPair, SaysTheDifferenceWithinItsStandardError) {
  int within = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(static_cast<unsigned>(run));
    GyroPair pair({});
    for (int i = 0; i < 1000; ++i) pair.update(reading(i, 0.003, 0.002, random));
    if (std::abs(*pair.disagreement_rad_s() - 0.003) < 2 * pair.standard_error_rad_s()) ++within;
  }
  // 99.9 % binomial limits about 95.4 %.
  EXPECT_GT(within, 179);
  EXPECT_LT(within, 200);
}

TEST(GyroPair, CalibrationsAreApplied) {
  std::mt19937_64 random(1);
  GyroPair pair({});
  pair.set_calibration({1, -0.003}, {1, 0});
  for (int i = 0; i < 1000; ++i) pair.update(reading(i, 0.003, 0, random));
  EXPECT_NEAR(*pair.disagreement_rad_s(), 0, 1e-12);
}

TEST(GyroPair, SaysNothingTooEarlyOrAfterAGapAndBadReadingsSpoilNothing) {
  std::mt19937_64 random(1);
  GyroPair pair({});
  for (int i = 0; i < 19; ++i) pair.update(reading(i, 0.003, 0.001, random));
  EXPECT_FALSE(pair.disagreement_rad_s());
  for (int i = 19; i < 100; ++i) {
    RateReading bad = reading(i, 0.003, 0.001, random);
    pair.update(bad);
    pair.update(bad);  // repeated
    bad.time_s += 0.01;
    bad.yaw_rate_b_rad_s = std::numeric_limits<double>::quiet_NaN();
    pair.update(bad);
    bad.yaw_rate_b_rad_s = 100;
    bad.saturated = true;
    pair.update(bad);
  }
  EXPECT_NEAR(*pair.disagreement_rad_s(), 0.003, 0.001);
  pair.update(reading(1000, 0.003, 0.001, random));
  EXPECT_FALSE(pair.disagreement_rad_s());
}

TEST(GyroPair, RestoredGoesOnBitForBit) {
  std::mt19937_64 random(1);
  GyroPair pair({}), restored({});
  for (int i = 0; i < 100; ++i) pair.update(reading(i, 0.003, 0.001, random));
  Archive saving;
  saving(pair);
  Archive restoring{std::string_view(saving.bytes())};
  restoring(restored);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  for (int i = 100; i < 150; ++i) {
    const RateReading next = reading(i, 0.003, 0.001, random);
    pair.update(next);
    restored.update(next);
  }
  EXPECT_EQ(pair.disagreement_rad_s(), restored.disagreement_rad_s());
  EXPECT_EQ(pair.standard_error_rad_s(), restored.standard_error_rad_s());
}

}  // namespace
}  // namespace navcal::calib
