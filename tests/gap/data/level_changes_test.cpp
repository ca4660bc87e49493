// SPDX-License-Identifier: Apache-2.0
#include "gap/data/level_changes.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::gap {
namespace {

using Indices = std::vector<std::size_t>;

/// Noise of standard deviation 1 about levels that begin at the given indices.
std::vector<double> series(std::size_t length, const std::vector<std::pair<std::size_t, double>>& levels,
                           unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  std::vector<double> values;
  double level = 0;
  for (std::size_t i = 0; i < length; ++i) {
    for (const auto& [at, value] : levels) {
      if (at == i) level = value;
    }
    values.push_back(level + noise(random));
  }
  return values;
}

TEST(LevelChanges, OneForGood) { EXPECT_EQ(LevelChanges{}.of(series(60, {{25, 12}}, 1)), (Indices{25})); }

TEST(LevelChanges, OneThatGoesAwayAgain) {
  EXPECT_EQ(LevelChanges{}.of(series(60, {{30, 12}, {36, 0}}, 2)), (Indices{30, 36}));
}

TEST(LevelChanges, Several) {
  EXPECT_EQ(LevelChanges{}.of(series(120, {{20, 12}, {40, 0}, {70, -12}, {80, 0}}, 3)), (Indices{20, 40, 70, 80}));
}

TEST(LevelChanges, NoneInNoise) {
  for (unsigned seed = 0; seed < 200; ++seed) EXPECT_TRUE(LevelChanges{}.of(series(90, {}, seed)).empty()) << seed;
}

TEST(LevelChanges, OneOrTwoPiecesAreNoLevel) {
  EXPECT_TRUE(LevelChanges{}.of(series(60, {{30, 12}, {31, 0}}, 4)).empty());
}

TEST(LevelChanges, SmallDifferencesDoNotCountWhateverTheirStatistic) {
  LevelChanges levels;
  levels.least_difference = 20;
  EXPECT_TRUE(levels.of(series(60, {{25, 12}}, 1)).empty());
}

TEST(LevelChanges, ShortSeriesHaveNone) {
  for (std::size_t length = 0; length < 8; ++length) EXPECT_TRUE(LevelChanges{}.of(series(length, {}, 5)).empty());
}

}  // namespace
}  // namespace navcal::gap
