// SPDX-License-Identifier: Apache-2.0
#include "pipeline/arrival_track.h"

#include <gtest/gtest.h>

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(ArrivalTrack, WireTimeOfAFrameInOneRead) {
  ArrivalTrack track(10'000);  // 1 ms a byte
  track.add(30, 100 * kMs);
  const auto frame = track.locate(0, 30);
  EXPECT_EQ(frame.arrival_ns, 100 * kMs);
  EXPECT_EQ(frame.start_ns, 70 * kMs);
  EXPECT_FALSE(frame.backlog);
}

TEST(ArrivalTrack, TheEarliestBoundOfSeveralReadsHolds) {
  ArrivalTrack track(10'000);
  track.add(10, 50 * kMs);
  track.add(10, 90 * kMs);  // held up
  track.add(10, 100 * kMs);
  const auto frame = track.locate(0, 30);
  EXPECT_EQ(frame.start_ns, 40 * kMs);
  EXPECT_EQ(frame.arrival_ns, 100 * kMs);
}

TEST(ArrivalTrack, BytesBehindTheFrameTookTimeOnTheWireToo) {
  ArrivalTrack track(10'000);
  track.add(50, 100 * kMs);
  const auto first = track.locate(0, 20);
  EXPECT_EQ(first.start_ns, 50 * kMs);
  EXPECT_TRUE(first.backlog);
  EXPECT_EQ(track.locate(20, 50).start_ns, 70 * kMs);
  EXPECT_FALSE(track.locate(20, 50).backlog);
}

TEST(ArrivalTrack, AFrameFoundLateKeepsTheArrivalOfItsLastByte) {
  ArrivalTrack track(10'000);
  track.add(40, 100 * kMs);
  track.add(5, 900 * kMs);  // only now the parser looked again
  EXPECT_EQ(track.locate(10, 40).arrival_ns, 100 * kMs);
  EXPECT_EQ(track.locate(10, 40).start_ns, 70 * kMs);
}

TEST(ArrivalTrack, ByteByByteOverManyReads) {
  ArrivalTrack track(10'000);
  for (int i = 1; i <= 3000; ++i) track.add(1, i * kMs);
  EXPECT_EQ(track.locate(2900, 3000).start_ns, 2900 * kMs);
  EXPECT_EQ(track.locate(2900, 3000).arrival_ns, 3000 * kMs);
}

}  // namespace
}  // namespace navcal::pipeline
