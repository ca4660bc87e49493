// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/durations.h"
#include "pipeline/surfacing.h"

namespace navcal::pipeline {
namespace {

using base::kSecond_ns;

constexpr double kAntenna_m = 0.35;

class SurfacingWatchTest : public testing::Test {
 protected:
  void depth(double time_s, double depth_m) { watch_.depth(std::llround(time_s * 1e9), depth_m); }
  std::optional<Surfacing> fix(double time_s) {
    instruments::GpsSample gps;
    gps.visible = 9;
    gps.tracked = 7;
    gps.dop = 2.5;
    return watch_.fix(std::llround(time_s * 1e9), gps);
  }
  SurfacingWatch watch_{kAntenna_m};
};

TEST_F(SurfacingWatchTest, MeasuresTheDiveAndTheSearch) {
  depth(1, 0);
  EXPECT_FALSE(fix(1));
  EXPECT_FALSE(fix(2));
  depth(3, 0.6);
  depth(50, 4);
  depth(90, 0.3);
  const auto surfacing = fix(97);
  ASSERT_TRUE(surfacing);
  EXPECT_EQ(surfacing->without_fix_s(), 95);
  EXPECT_EQ(surfacing->submerged_s(), 87);
  EXPECT_EQ(surfacing->time_to_first_fix_s(), 7);
  EXPECT_EQ(surfacing->deepest_m, 4);
  EXPECT_EQ(surfacing->tracked, 7);
  EXPECT_EQ(surfacing->visible, 9);
  EXPECT_EQ(surfacing->dop, 2.5);
  EXPECT_EQ(words_for(*surfacing),
            "87 s under water, down to 4.0 m; first fix 7.0 s after surfacing, 7 satellites, DOP 2.5");
  EXPECT_FALSE(fix(98)) << "told once";
}

TEST_F(SurfacingWatchTest, NoiseAndWavesAtTheSurfaceAreNoDive) {
  for (int i = 0; i < 100; ++i) {
    depth(i, kAntenna_m + (i % 2 == 0 ? 0.1 : -0.1));
    if (i > 90) {
      EXPECT_FALSE(fix(i)) << "a loss of fixes at the surface is none";
    }
  }
}

TEST_F(SurfacingWatchTest, TwoDivesWithoutAFixBetweenAreOneAndTheLastSurfacingCounts) {
  fix(0);
  depth(10, 2);
  depth(20, 0);
  depth(22, 3);
  depth(40, 0.4);
  depth(41, 0.2);
  const auto surfacing = fix(45);
  ASSERT_TRUE(surfacing);
  EXPECT_NEAR(surfacing->submerged_s().value(), 31, 1e-9);
  EXPECT_EQ(surfacing->time_to_first_fix_s(), 4);
  EXPECT_EQ(surfacing->deepest_m, 3);
}

TEST_F(SurfacingWatchTest, AFixOfTheTimeBeforeTheDiveThatArrivesLateEndsNothing) {
  fix(9);
  depth(10.2, 2);
  EXPECT_FALSE(fix(10));
  depth(30, 0);
  ASSERT_TRUE(fix(33));
}

TEST_F(SurfacingWatchTest, FixesUnderWaterHaveNoTimeOfSurfacing) {
  fix(0);
  depth(10, 2);
  EXPECT_FALSE(fix(11)) << "the second of the dive itself";
  const auto surfacing = fix(14);
  ASSERT_TRUE(surfacing);
  EXPECT_FALSE(surfacing->time_to_first_fix_s());
  EXPECT_FALSE(surfacing->submerged_s());
}

TEST_F(SurfacingWatchTest, WithoutAGaugeOnlyTheStretchIsKnown) {
  EXPECT_FALSE(fix(5)) << "the first of all";
  EXPECT_FALSE(fix(14));
  const auto surfacing = fix(60);
  ASSERT_TRUE(surfacing);
  EXPECT_EQ(surfacing->without_fix_s(), 46);
  EXPECT_FALSE(surfacing->submerged_s());
  EXPECT_FALSE(surfacing->time_to_first_fix_s());
  EXPECT_EQ(words_for(*surfacing).rfind("first fix after 46 s without one; the time of surfacing is not known", 0),
            0U);
}

TEST_F(SurfacingWatchTest, ADiveBeforeTheFirstFixHasNoStretchWithout) {
  depth(1, 5);
  depth(30, 0);
  const auto surfacing = fix(36);
  ASSERT_TRUE(surfacing);
  EXPECT_FALSE(surfacing->without_fix_s());
  EXPECT_EQ(surfacing->time_to_first_fix_s(), 6);
}

TEST_F(SurfacingWatchTest, ReadingsThatCannotBeAndFixesOutOfOrderAreLeftOut) {
  fix(10);
  depth(11, std::nan(""));
  EXPECT_FALSE(fix(9));
  depth(12, 2);
  depth(20, 0);
  EXPECT_FALSE(fix(10));
  EXPECT_TRUE(fix(25));
}

}  // namespace
}  // namespace navcal::pipeline
