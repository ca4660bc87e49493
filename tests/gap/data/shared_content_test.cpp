// SPDX-License-Identifier: Apache-2.0
#include "gap/data/shared_content.h"

#include <gtest/gtest.h>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

Mission part_of(Mission mission, double from_s, double until_s) {
  const auto outside = [=](const auto& reading) { return reading.time_s < from_s || reading.time_s >= until_s; };
  std::erase_if(mission.card, outside);
  std::erase_if(mission.compass, outside);
  for (auto& reading : mission.card) reading.time_s -= from_s;
  for (auto& reading : mission.compass) reading.time_s -= from_s;
  return mission;
}

TEST(SharedContent, ARecordingHoldsItselfAndItsParts) {
  const Mission whole = test::simulated_mission("identification", "", 60, 1);
  const SharedContent content(whole);
  EXPECT_GT(content.shared_s(content), 55);
  const SharedContent part(part_of(whole, 20, 30));
  EXPECT_NEAR(part.shared_s(content), 10, 1.5);
  EXPECT_NEAR(content.shared_s(part), 10, 1.5);
}

TEST(SharedContent, OneInstrumentIsEnough) {
  const Mission whole = test::simulated_mission("identification", "", 60, 1);
  Mission without_card = whole;
  without_card.card.clear();
  EXPECT_GT(SharedContent(without_card).shared_s(SharedContent(whole)), 50);
}

TEST(SharedContent, AnotherSeedOfTheSameMissionSharesNothing) {
  const SharedContent a(test::simulated_mission("identification", "", 60, 1));
  const SharedContent b(test::simulated_mission("identification", "", 60, 2));
  EXPECT_EQ(a.shared_s(b), 0);
}

TEST(SharedContent, ReadingsThatNeverChangeProveNothing) {
  Mission rest;
  for (int i = 0; i < 1000; ++i) rest.card.push_back({.time_s = 0.05 * i});
  EXPECT_EQ(SharedContent(rest).shared_s(SharedContent(rest)), 0);
  EXPECT_EQ(SharedContent(Mission{}).shared_s(SharedContent(Mission{})), 0);
}

}  // namespace
}  // namespace navcal::gap
