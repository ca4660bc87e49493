// SPDX-License-Identifier: Apache-2.0
#include "pipeline/arrival_track.h"

#include <gtest/gtest.h>

#include "base/durations.h"

namespace navcal::pipeline {
namespace {

TEST(ArrivalTrack, WireTimeOfAFrameInOneRead) {
  ArrivalTrack track(10'000);  // 1 ms a byte
  track.add(30, 100 * base::kMillisecond_ns);
  const auto frame = track.locate(0, 30);
  EXPECT_EQ(frame.arrival_ns, 100 * base::kMillisecond_ns);
  EXPECT_EQ(frame.start_ns, 70 * base::kMillisecond_ns);
  EXPECT_FALSE(frame.backlog);
}

TEST(ArrivalTrack, TheEarliestBoundOfSeveralReadsHolds) {
  ArrivalTrack track(10'000);
  track.add(10, 50 * base::kMillisecond_ns);
  track.add(10, 90 * base::kMillisecond_ns);  // held up
  track.add(10, 100 * base::kMillisecond_ns);
  const auto frame = track.locate(0, 30);
  EXPECT_EQ(frame.start_ns, 40 * base::kMillisecond_ns);
  EXPECT_EQ(frame.arrival_ns, 100 * base::kMillisecond_ns);
}

TEST(ArrivalTrack, BytesBehindTheFrameTookTimeOnTheWireToo) {
  ArrivalTrack track(10'000);
  track.add(50, 100 * base::kMillisecond_ns);
  const auto first = track.locate(0, 20);
  EXPECT_EQ(first.start_ns, 50 * base::kMillisecond_ns);
  EXPECT_TRUE(first.backlog);
  EXPECT_EQ(track.locate(20, 50).start_ns, 70 * base::kMillisecond_ns);
  EXPECT_FALSE(track.locate(20, 50).backlog);
}

TEST(ArrivalTrack, AFrameFoundLateKeepsTheArrivalOfItsLastByte) {
  ArrivalTrack track(10'000);
  track.add(40, 100 * base::kMillisecond_ns);
  track.add(5, 900 * base::kMillisecond_ns);  // only now the parser looked again
  EXPECT_EQ(track.locate(10, 40).arrival_ns, 100 * base::kMillisecond_ns);
  EXPECT_EQ(track.locate(10, 40).start_ns, 70 * base::kMillisecond_ns);
}

TEST(ArrivalTrack, ByteByByteOverManyReads) {
  ArrivalTrack track(10'000);
  for (int i = 1; i <= 3000; ++i) track.add(1, i * base::kMillisecond_ns);
  EXPECT_EQ(track.locate(2900, 3000).start_ns, 2900 * base::kMillisecond_ns);
  EXPECT_EQ(track.locate(2900, 3000).arrival_ns, 3000 * base::kMillisecond_ns);
}

}  // namespace
}  // namespace navcal::pipeline
