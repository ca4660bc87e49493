// SPDX-License-Identifier: Apache-2.0
// All four instruments on their lines.
#include "sim/recording.h"

#include <gtest/gtest.h>

#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/oncore.h"
#include "protocols/tcm2.h"
#include "sim/path.h"
#include "tests/sim/drive.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

std::vector<LineRead> recorded(const Recording::Options& options, double seconds, double step_s = 1) {
  Recording::Options from = options;
  from.begin_ns = kStart_ns;
  const PathMotion motion(default_path(), kStart_ns);
  Recording recording(from, motion);
  std::vector<LineRead> reads;
  for (double t_s = step_s; t_s < seconds + step_s / 2; t_s += step_s) {
    recording.advance(kStart_ns + static_cast<std::int64_t>(t_s * 1e9), reads);
  }
  return reads;
}

struct Tally {
  std::array<protocols::Counters, kInstruments> counters;
  std::array<int, kInstruments> frames{};
};

Tally tally(const std::vector<LineRead>& reads) {
  protocols::tcm2::Parser compass;
  protocols::imu_card::Parser card;
  protocols::oncore::Parser receiver;
  protocols::motor_card::Parser motor;
  Tally tally;
  for (const LineRead& read : reads) {
    if (read.sent) continue;
    const auto i = static_cast<std::size_t>(read.of);
    const auto count = [&](const protocols::Frame&) { ++tally.frames[i]; };
    if (read.of == Instrument::compass) compass.feed(read.bytes, count);
    if (read.of == Instrument::imu) card.feed(read.bytes, count);
    if (read.of == Instrument::gps) receiver.feed(read.bytes, count);
    if (read.of == Instrument::motor) motor.feed(read.bytes, count);
  }
  tally.counters = {compass.counters(), card.counters(), receiver.counters(), motor.counters()};
  return tally;
}

bool same(const std::vector<LineRead>& a, const std::vector<LineRead>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LineRead& x, const LineRead& y) {
    return x.time_ns == y.time_ns && x.of == y.of && x.bytes == y.bytes;
  });
}

TEST(SimulatedRecording, HoldsEveryFrameWholeAndInOrder) {
  const auto reads = recorded({}, 20);
  std::int64_t last_ns = kStart_ns;
  for (const LineRead& read : reads) {
    EXPECT_GE(read.time_ns, last_ns);
    EXPECT_FALSE(read.bytes.empty());
    last_ns = read.time_ns;
  }
  const Tally all = tally(reads);
  for (const auto& counters : all.counters) {
    EXPECT_EQ(counters.bad_checksum, 0U);
    EXPECT_EQ(counters.skipped_bytes, 0U);
  }
  EXPECT_EQ(all.frames[0], 1 + 198 - 1)
      << "a banner, and ten words a second from 0.3 s on but for the one under way";
  EXPECT_EQ(all.frames[1], 399) << "one is under way";
  EXPECT_EQ(all.frames[2], 19);
  EXPECT_EQ(all.frames[3], 199);
}

TEST(SimulatedRecording, IsTheSameForTheSameSeedHoweverItIsAskedFor) {
  const auto reads = recorded({}, 10);
  EXPECT_TRUE(same(reads, recorded({}, 10, 0.35 * 10 / 10.5)));
  Recording::Options other;
  other.seed = 2;
  EXPECT_FALSE(same(reads, recorded(other, 10)));
}

TEST(SimulatedRecording, AReadNeverReturnsBeforeItsBytesHaveCome) {
  Recording::Options quiet;
  quiet.noise = false;
  const auto reads = recorded(quiet, 5);
  std::int64_t frame_ns = 0;
  std::size_t bytes = 0;
  for (const LineRead& read : reads) {
    if (read.of != Instrument::imu) continue;
    if (bytes % protocols::imu_card::kFrameLength == 0) {
      frame_ns = kStart_ns + static_cast<std::int64_t>(bytes / protocols::imu_card::kFrameLength + 1) * 50'000'000;
    }
    const std::size_t in_frame = bytes % protocols::imu_card::kFrameLength + read.bytes.size();
    EXPECT_EQ(read.time_ns, frame_ns + static_cast<std::int64_t>(in_frame) * 10'000'000'000 / 57600);
    bytes += read.bytes.size();
  }
  EXPECT_GT(bytes, 90 * protocols::imu_card::kFrameLength);
}

TEST(SimulatedRecording, LinesLoseRepeatAndHoldBackWhatTheirEffectsSay) {
  EffectSet effects(kStart_ns);
  effects.add(effect_with("dropped_frames", {0, 1, 0, 0}), {5, 100});
  effects.add(effect_with("repeated_frames", {0, 0, 0, 1}));
  effects.add(effect_with("stalls", {2, 60}), {0, 10});
  effects.reseed(1);
  Recording::Options options;
  options.effects = &effects;
  const auto reads = recorded(options, 20);
  const Tally all = tally(reads);
  EXPECT_EQ(all.frames[1], 99);
  EXPECT_NEAR(all.frames[3], 2 * 199, 1);
  for (const auto& counters : all.counters) EXPECT_EQ(counters.bad_checksum, 0U);
  std::size_t largest = 0;
  for (const LineRead& read : reads) largest = std::max(largest, read.bytes.size());
  EXPECT_GT(largest, 200U) << "what was held back comes at once";
}

TEST(SimulatedRecording, AClockThatRunsSlowSendsFewerFrames) {
  EffectSet effects(kStart_ns);
  effects.add(effect_with("clock_error", {0, 10000, 0}));
  Recording::Options options;
  options.effects = &effects;
  EXPECT_NEAR(tally(recorded(options, 101)).frames[1], 2000, 1) << "and not 2020";
}

}  // namespace
}  // namespace navcal::sim::testing
