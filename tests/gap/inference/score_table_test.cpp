// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gap/inference/subset_search.h"

namespace navcal::gap {
namespace {

const EffectSubset kNone{}, kA{1}, kB{2}, kBoth{1, 2};

TEST(ScoreTable, TheFirstInitialScoreStaysUntilTheFinalOne) {
  ScoreTable table;
  table.set_initial(kA, 3);
  table.set_initial(kA, 7);
  EXPECT_EQ(table.scores().at(kA), 3);
  EXPECT_FALSE(table.is_settled(kA));
  table.set_final(kA, 1);
  EXPECT_EQ(table.scores().at(kA), 1);
  EXPECT_TRUE(table.is_settled(kA));
  table.set_initial(kA, 9);
  EXPECT_EQ(table.scores().at(kA), 1);
}

TEST(ScoreTable, NoFinalScoreIsBelowTheHighestFloor) {
  ScoreTable table;
  table.raise_floor(kA, 4);
  table.raise_floor(kA, 2);
  EXPECT_EQ(table.scores().at(kA), 4);
  EXPECT_FALSE(table.is_settled(kA));
  table.set_final(kA, 1);
  EXPECT_EQ(table.scores().at(kA), 4);
  table.set_final(kA, 6);
  EXPECT_EQ(table.scores().at(kA), 6);
  table.set_final(kA, 5);
  EXPECT_EQ(table.scores().at(kA), 5);
}

TEST(ScoreTable, AFloorDoesNotLowerAScore) {
  ScoreTable table;
  table.set_initial(kA, 8);
  table.raise_floor(kA, 4);
  EXPECT_EQ(table.scores().at(kA), 8);
}

TEST(ScoreTable, TheLeaderHasTheHighestScore) {
  ScoreTable table;
  table.set_final(kNone, 0);
  EXPECT_EQ(table.leader(), kNone);
  table.set_initial(kBoth, 2);
  table.set_final(kA, 1);
  EXPECT_EQ(table.leader(), kBoth);
  table.set_final(kBoth, -1);
  EXPECT_EQ(table.leader(), kA);
}

TEST(ScoreTable, LeadingSubsetsAreOfOneSizeAndInOrderOfTheirScores) {
  ScoreTable table;
  table.set_initial(kA, 1);
  table.set_initial(kB, 2);
  table.set_initial({3}, 3);
  table.set_initial(kBoth, 9);
  EXPECT_EQ(table.leading(1, 2), (std::vector<EffectSubset>{{3}, kB}));
  EXPECT_EQ(table.leading(1, 9).size(), 3U);
  EXPECT_EQ(table.leading(2, 2), (std::vector<EffectSubset>{kBoth}));
  EXPECT_TRUE(table.leading(3, 2).empty());
  EXPECT_TRUE(table.leading(1, 0).empty());
}

}  // namespace
}  // namespace navcal::gap
