// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "calib/coverage.h"

namespace navcal::calib {
namespace {

TEST(FieldCoverage, ASingleHeadingCoversNothingWhereverItLies) {
  for (int i = 0; i < 10'000; ++i) {
    const double heading_rad = 0.001 * i - 5;
    const FieldCoverage coverage({heading_rad, heading_rad});
    EXPECT_GE(coverage.arc_rad(), 0) << heading_rad;
    EXPECT_LT(coverage.arc_rad(), 1e-12) << heading_rad;
  }
}

TEST(FieldCoverage, IsTheCircleLessTheLargestGap) {
  EXPECT_NEAR(
      FieldCoverage({350 * base::kRadiansPerDegree, 10 * base::kRadiansPerDegree, 60 * base::kRadiansPerDegree})
          .arc_rad(),
      70 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(FieldCoverage({0, 2, 4}).arc_rad(), 4, 1e-12);
  EXPECT_EQ(FieldCoverage({}).arc_rad(), 0);
  EXPECT_EQ(FieldCoverage({NAN}).arc_rad(), 0);
}

}  // namespace
}  // namespace navcal::calib
