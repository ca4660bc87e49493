// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/verdict/holdout.h"

namespace navcal::gap {
namespace {

constexpr std::size_t kBlocks = 60;
constexpr double kMeasurementsPerBlock = 1000;

/// A mission whose whitened residuals have mean square `before` and, with the effects, `after`; the noise, which
/// both share, has mean square 1.
Comparison mission(double before, double after, double floor_std = 0.01, std::uint64_t seed = 0) {
  Comparison made;
  made.floor = 1;
  made.floor_std = floor_std;
  made.measurements = kMeasurementsPerBlock * static_cast<double>(kBlocks);
  std::mt19937_64 random(seed);
  const double block_std = seed == 0 ? 0 : std::sqrt(2 / kMeasurementsPerBlock);
  std::normal_distribution<double> normal;
  // The floor that the nulls say is off by their own scatter.
  if (seed != 0) made.floor += floor_std * std::normal_distribution<double>()(random);
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const double noise = 1 + block_std * normal(random);
    made.before.blocks.push_back(kMeasurementsPerBlock * (noise + before - 1));
    made.after.blocks.push_back(kMeasurementsPerBlock * (noise + after - 1));
    made.before.mean_square += (noise + before - 1) / static_cast<double>(kBlocks);
    made.after.mean_square += (noise + after - 1) / static_cast<double>(kBlocks);
  }
  return made;
}

TEST(PooledClosure, NothingMeasuredIsNoGap) {
  EXPECT_FALSE(pooled_closure(std::vector<Comparison>{}).clear);
  EXPECT_FALSE(pooled_closure({Comparison{}}).clear);
}

TEST(PooledClosure, AGapWithinTheScatterOfTheNullsIsNotClear) {
  EXPECT_FALSE(pooled_closure({mission(1.02, 1, 0.01)}).clear);
  EXPECT_TRUE(pooled_closure({mission(1.04, 1, 0.01)}).clear);
}

TEST(PooledClosure, WhatRemainsAboveTheFloorIsNotClosed) {
  EXPECT_NEAR(pooled_closure({mission(3, 1)}).closed, 1, 1e-9);
  EXPECT_NEAR(pooled_closure({mission(3, 1.5)}).closed, 0.75, 1e-9);
  EXPECT_NEAR(pooled_closure({mission(3, 3)}).closed, 0, 1e-9);
  EXPECT_NEAR(pooled_closure({mission(3, 4)}).closed, -0.5, 1e-9);
}

TEST(PooledClosure, MissionsCountByTheirMeasurements) {
  Comparison shorter = mission(3, 3);
  shorter.measurements /= 3;
  for (auto* power : {&shorter.before, &shorter.after}) {
    for (double& block : power->blocks) block /= 3;
  }
  EXPECT_NEAR(pooled_closure({mission(3, 1), shorter}).closed, 0.75, 1e-9);
}

TEST(PooledClosure, WhatIsGivenAsLeftCountsInsteadOfTheEffectsAlone) {
  const Comparison effects_alone = mission(3, 2);
  const PooledClosure by_all = pooled_closure({effects_alone}, {mission(3, 1).after});
  EXPECT_NEAR(by_all.closed, 1, 1e-9);
  EXPECT_NEAR(pooled_closure({effects_alone}).closed, 0.5, 1e-9);
}

TEST(PooledClosure, MissionsThatDifferOnlyByTheirGapAreWeighedByTheirGap) {
  // One gap of 3 is closed, one of 1 stays: three quarters of the power are gone.
  EXPECT_NEAR(pooled_closure({mission(4, 1), mission(2, 2)}).closed, 0.75, 1e-9);
}

TEST(PooledClosure, TheIntervalIsThatOfTheBlocksAndOfTheFloor) {
  const PooledClosure exact = pooled_closure({mission(3, 1.5, 0)});
  EXPECT_NEAR(exact.lower, 0.75, 1e-9) << "blocks alike and a floor that is known";
  EXPECT_NEAR(exact.upper, 0.75, 1e-9);
  const PooledClosure narrow = pooled_closure({mission(3, 1.5, 0.05)}),
                      wide = pooled_closure({mission(3, 1.5, 0.2)});
  EXPECT_LT(narrow.lower, 0.75);
  EXPECT_GT(narrow.upper, 0.75);
  EXPECT_GT(wide.upper - wide.lower, 2 * (narrow.upper - narrow.lower));
  EXPECT_EQ(pooled_closure({mission(3, 1.5, 0.2)}).lower, wide.lower) << "the same draws each time";
}

TEST(PooledClosure, AGapThatGrowsHasANegativeInterval) {
  const PooledClosure grown = pooled_closure({mission(3, 5)});
  ASSERT_TRUE(grown.clear);
  EXPECT_NEAR(grown.closed, -1, 1e-9);
  EXPECT_LT(grown.upper, 0);
}

TEST(PooledClosure, TheIntervalHoldsTheTruthAsOftenAsItSays) {
  constexpr double kTruth = 0.9;
  int held = 0;
  constexpr int kTrials = 200;
  for (int n = 1; n <= kTrials; ++n) {
    const auto seed = static_cast<std::uint64_t>(n);
    const PooledClosure found =
        pooled_closure({mission(1.5, 1.05, 0.01, seed), mission(1.5, 1.05, 0.01, seed + 1000)});
    ASSERT_TRUE(found.clear);
    EXPECT_LE(found.lower, found.closed);
    EXPECT_GE(found.upper, found.closed);
    held += static_cast<int>(found.lower <= kTruth && kTruth <= found.upper);
  }
  // 95 % of 200, within three standard deviations of a binomial.
  EXPECT_GE(held, 180);
  EXPECT_LE(held, 199);
}

}  // namespace
}  // namespace navcal::gap
