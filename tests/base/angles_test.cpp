// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace navcal::base {
namespace {

constexpr double kAngles[] = {0,    1e-300, -1e-300, 1e-17, -1e-17, 1,    -1,  3.2,
                              -3.2, 6.28,   -6.28,   6.3,   100,    -100, 1e6, -1e6};

/// How far two angles are apart as directions.
double apart(double a, double b) { return std::abs(std::remainder(a - b, kTurn_rad)); }

TEST(Angles, AreTheSameDirectionWithinTheirRange) {
  for (const double angle : kAngles) {
    SCOPED_TRACE(angle);
    EXPECT_LE(std::abs(wrapped(angle)), std::numbers::pi);
    for (const double heading : {positive_angle(angle), as_heading(angle)}) {
      EXPECT_GE(heading, 0);
      EXPECT_LT(heading, kTurn_rad);
      EXPECT_LT(apart(heading, angle), 1e-9);
    }
    EXPECT_LT(apart(wrapped(angle), angle), 1e-9);
  }
}

TEST(Angles, AnAngleThatIsPositiveAlreadyComesBackBitForBit) {
  for (double angle = 0; angle < kTurn_rad; angle += 0.0137) EXPECT_EQ(positive_angle(angle), angle);
}

TEST(Angles, WhatIsNoNumberStaysNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(wrapped(kNan)));
  EXPECT_TRUE(std::isnan(wrapped(std::numeric_limits<double>::infinity())));
}

}  // namespace
}  // namespace navcal::base
