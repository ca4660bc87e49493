// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "calib/turn/held_out.h"

namespace navcal::calib::test {
namespace {

constexpr double kMarginOfTest = 0.1;

/// Blocks with such mean squares, each multiplied by a random factor.
Comparison compared(double before, double in_force, double estimate, int blocks, double scatter,
                    std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::lognormal_distribution<double> factor(0, scatter);
  Comparison comparison;
  for (int i = 0; i < blocks; ++i) {
    comparison.add(before * factor(random), in_force * factor(random), estimate * factor(random));
  }
  return comparison;
}

TEST(Comparison, WhatIsActiveIsWorseThanNothingByTheMarginAndThreeErrors) {
  EXPECT_TRUE(compared(1, 2, 2, 10, 0.1).worse_by(kMarginOfTest));
  EXPECT_FALSE(compared(1, 2, 2, 2, 0.1).worse_by(kMarginOfTest)) << "fewer than three blocks";
  EXPECT_FALSE(compared(1, 1.1, 1.1, 40, 0.001).worse_by(kMarginOfTest)) << "within the margin";
  EXPECT_FALSE(compared(2, 1, 1, 10, 0.1).worse_by(kMarginOfTest)) << "it is better";
  EXPECT_FALSE(compared(1, 2, 2, 4, 1.5).worse_by(kMarginOfTest)) << "by chance";
}

TEST(Comparison, AChangeBeginsAnew) {
  Comparison comparison = compared(1, 4, 4, 20, 0.1);
  ASSERT_TRUE(comparison.worse_by(kMarginOfTest));
  comparison.on_change();
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(comparison.worse_by(kMarginOfTest));
    comparison.add(1 + 0.1 * (i % 2), 1 + 0.1 * (i % 2), 4);  // nothing is active
  }
  EXPECT_FALSE(comparison.better_by(kMarginOfTest)) << "what has left does not come back";
}

// Three errors of a mean of three blocks are passed by chance in 5 % (Student, two degrees of freedom), of many in
// 1 %.
TEST(Comparison, WithoutADifferenceLittleLeavesForce) {
  int after_three = 0, after_more = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    after_three += compared(1, 1, 1, 3, 0.4, seed).worse_by(kMarginOfTest) ? 1 : 0;
    for (const int blocks : {12, 30})
      after_more += compared(1, 1, 1, blocks, 0.4, seed).worse_by(kMarginOfTest) ? 1 : 0;
  }
  EXPECT_LE(after_three, 20) << "of 200";
  EXPECT_LE(after_more, 8) << "of 400";
}

}  // namespace
}  // namespace navcal::calib::test
