// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "gap/nulls/null_bayes_factors.h"

namespace navcal::gap {
namespace {

TEST(StandsOut, OnlyWhatIsBeyondTheScatterOfNulls) {
  const std::array<double, 5> quiet{-6, -5, -7, -6, -6};
  EXPECT_TRUE(stands_out(0, quiet));
  EXPECT_FALSE(stands_out(-5, quiet));
  const std::array<double, 5> noisy{-20, 5, 100, 0, 60};
  EXPECT_FALSE(stands_out(150, noisy));
  EXPECT_TRUE(stands_out(200, noisy));
}

TEST(StandsOut, NeedsMoreThanALittleWhereNullsAreAlike) {
  const std::array<double, 3> alike{-6, -6, -6};
  EXPECT_FALSE(stands_out(-4, alike));
  EXPECT_TRUE(stands_out(-2, alike));
  EXPECT_TRUE(stands_out(1, {})) << "nobody could follow: nothing is known against it";
}

}  // namespace
}  // namespace navcal::gap
