// SPDX-License-Identifier: Apache-2.0
#include "gap/data/mission_piece.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

TEST(MissionPiece, PiecesHoldEachReadingOnce) {
  const Mission whole = test::simulated_mission("identification", "", 90, 3);
  std::size_t frames = 0, words = 0, fixes = 0, orders = 0;
  for (double from_s = 0; from_s < 100; from_s += 25) {
    const Mission piece = piece_of(whole, from_s, from_s + 25);
    frames += piece.card.size();
    words += piece.compass.size();
    fixes += piece.fixes.size();
    orders += piece.order_times_s.size();
    for (const CardReading& frame : piece.card) {
      EXPECT_GE(frame.time_s, 0);
      EXPECT_LT(frame.time_s, 25);
    }
  }
  EXPECT_EQ(frames, whole.card.size());
  EXPECT_EQ(words, whole.compass.size());
  EXPECT_EQ(fixes, whole.fixes.size());
  EXPECT_EQ(orders, whole.order_times_s.size());
}

TEST(MissionPiece, KeepsNumbersOfFixesFieldAndInstruments) {
  const Mission whole = test::simulated_mission("survey", "", 60, 3);
  const Mission piece = piece_of(whole, 5, 60);
  ASSERT_FALSE(piece.fixes.empty());
  const auto first =
      std::find_if(whole.fixes.begin(), whole.fixes.end(), [](const FixReading& fix) { return fix.time_s >= 5; });
  EXPECT_EQ(piece.fixes.front().number, first->number);
  EXPECT_EQ(piece.field.north_east_down_uT, whole.field.north_east_down_uT);
  EXPECT_EQ(piece.duration_s, whole.duration_s - 5);
}

}  // namespace
}  // namespace navcal::gap
