// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_misbehaviour.h"

#include <gtest/gtest.h>

#include <bit>

namespace navcal::cli {
namespace {

TEST(Misbehaviour, PlansAreReadStrictly) {
  const auto stall = emulation::parse_stall("0.5@10");
  ASSERT_TRUE(stall);
  EXPECT_EQ(stall->duration_s, 0.5);
  EXPECT_EQ(stall->every_s, 10);
  for (const char* wrong : {"", "5", "@", "5@", "@5", "0@5", "6@5", "-1@5", "1@5s", "nan@5", "1@inf"}) {
    EXPECT_FALSE(emulation::parse_stall(wrong)) << wrong;
  }
  const auto unplug = emulation::parse_unplug("compass@2.5+3");
  ASSERT_TRUE(unplug);
  EXPECT_EQ(unplug->port, "compass");
  EXPECT_EQ(unplug->at_s, 2.5);
  EXPECT_EQ(unplug->duration_s, 3);
  for (const char* wrong :
       {"", "compass", "compass@2", "@2+3", "compass@+3", "compass@2+", "compass@-2+3", "a+b@2"}) {
    EXPECT_FALSE(emulation::parse_unplug(wrong)) << wrong;
  }
}

TEST(Misbehaviour, AGoodLineChangesNothing) {
  emulation::Misbehaviour line(1);
  const std::vector<std::uint8_t> frame{1, 2, 3};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(line.corrupt(frame), frame);
}

TEST(Misbehaviour, NoiseFlipsOneBitOrPutsGarbageBefore) {
  emulation::Misbehaviour line(2);
  line.set_noise(1);
  const std::vector<std::uint8_t> frame{0, 255, 7, 9};
  int flipped = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto spoiled = line.corrupt(frame);
    if (spoiled.size() == frame.size()) {
      int bits = 0;
      for (std::size_t k = 0; k < frame.size(); ++k)
        bits += std::popcount(static_cast<unsigned>(spoiled[k] ^ frame[k]));
      EXPECT_EQ(bits, 1);
      ++flipped;
    } else {
      ASSERT_GT(spoiled.size(), frame.size());
      EXPECT_LE(spoiled.size(), frame.size() + 8);
      EXPECT_TRUE(std::equal(frame.rbegin(), frame.rend(), spoiled.rbegin()));
    }
  }
  EXPECT_GT(flipped, 400);
  EXPECT_LT(flipped, 600);
}

TEST(Misbehaviour, DropsAsOftenAsTold) {
  emulation::Misbehaviour line(3);
  line.set_drop(0.25);
  int dropped = 0;
  for (int i = 0; i < 4000; ++i) dropped += line.corrupt({1}).empty() ? 1 : 0;
  EXPECT_NEAR(dropped, 1000, 120);
}

}  // namespace
}  // namespace navcal::cli
