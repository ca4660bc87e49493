// SPDX-License-Identifier: Apache-2.0
// Streams that no even clock explains: stamped by what was observed, with an error that holds.
#include <gtest/gtest.h>

#include <functional>

#include "tests/instruments/frame_stream.h"

namespace navcal::instruments {
namespace {

using Random = std::mt19937_64;

/// Frames measured when `next_s` says, after the one before; read a millisecond later in the mean.
std::vector<StreamFrame> measured(int count, unsigned seed, const std::function<double(Random&)>& interval_s) {
  Random random(seed);
  std::exponential_distribution<double> delay(1000);
  std::vector<StreamFrame> frames;
  double time_s = 1000;
  for (int k = 0; k < count; ++k) {
    frames.push_back({time_s, {.observed_ns = std::llround((time_s + delay(random)) * 1e9)}});
    time_s += interval_s(random);
  }
  return read_by_host(frames);
}

StreamScore all_of(const std::vector<StreamFrame>& frames, FrameClock& clock) {
  StreamScores scores;
  scores.run(clock, frames);
  EXPECT_FALSE(scores.backwards);
  StreamScore all = scores.first;
  all.add(scores.learning);
  all.add(scores.steady);
  return all;
}

TEST(IrregularStream, AWordEverySoManySecondsIsStampedByItsArrival) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::uniform_real_distribution<double> interval(4, 11);
    FrameClock clock(10, 0);
    const auto score = all_of(measured(400, seed, [&](Random& random) { return interval(random); }), clock);
    EXPECT_EQ(clock.state().timing, Timing::irregular);
    EXPECT_LT(score.rms_s(), 50e-3);
    EXPECT_GT(score.coverage(), 0.95);
  }
}

TEST(IrregularStream, APolledLoggerIsNoClock) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::uniform_real_distribution<double> interval(0.1, 0.12);
    FrameClock clock(10, 0);
    const auto score = all_of(measured(3000, seed, [&](Random& random) { return interval(random); }), clock);
    EXPECT_EQ(clock.state().timing, Timing::irregular);
    EXPECT_LT(score.rms_s(), 12e-3);
    EXPECT_GT(score.coverage(), 0.95);
  }
}

TEST(IrregularStream, WhatIsMuchTooFastIsStampedByItsArrival) {
  FrameClock clock(10, 0);
  const auto score = all_of(measured(3000, 1, [](Random&) { return 1 / 30.0; }), clock);
  EXPECT_EQ(clock.state().timing, Timing::irregular);
  EXPECT_GT(score.coverage(), 0.95);
}

TEST(IrregularStream, IsToldOnceAndSoIsItsEnd) {
  std::uniform_real_distribution<double> interval(4, 11);
  auto frames = measured(200, 1, [&](Random& random) { return interval(random); });
  const auto even = measured(600, 2, [](Random&) { return 0.1; });
  for (auto frame : even) {
    frame.observation.observed_ns += 3'000'000'000'000;
    frames.push_back(frame);
  }
  FrameClock clock(10, 0);
  std::vector<ClockNews> news;
  for (const auto& frame : frames) {
    if (const auto outcome = clock.update(frame.observation); outcome.news) news.push_back(*outcome.news);
  }
  EXPECT_EQ(news, (std::vector{ClockNews::irregular, ClockNews::regular}));
  EXPECT_EQ(clock.state().timing, Timing::periodic);
}

/// 12 Hz, three frames at a time: the first two of each three wait for the third.
std::vector<StreamFrame> in_threes(bool counted) {
  std::vector<StreamFrame> frames;
  Random random(1);
  std::exponential_distribution<double> delay(2000);
  for (int k = 0; k < 3000; ++k) {
    const double sent_s = 1000 + (k - k % 3 + 2) / 12.0 + delay(random) + 0.002 * (k % 3);
    StreamFrame frame{1000 + k / 12.0, {.observed_ns = std::llround(sent_s * 1e9)}};
    if (counted) frame.observation.sequence = static_cast<std::uint8_t>(k);
    frames.push_back(frame);
  }
  return frames;
}

TEST(IrregularStream, BurstsAreSpreadEvenlyAndTheClaimHoldsTheirLength) {
  for (const bool counted : {false, true}) {
    FrameClock clock(12, 0);
    StreamScores scores;
    scores.run(clock, in_threes(counted));
    EXPECT_EQ(clock.state().timing, Timing::bursts) << counted;
    EXPECT_FALSE(scores.backwards);
    EXPECT_LT(scores.steady.rms_s(), 10e-3) << counted;
    // The instrument may as well have measured when it sent: up to two periods later.
    EXPECT_GT(2 * scores.steady.claimed_rms_s(), 1.8 / 12) << counted;
    EXPECT_EQ(clock.lost(), 0U) << counted;
  }
}

/// Even ticks whose stamps are spoilt by `error_s`.
StreamScore spoilt(unsigned seed, const std::function<double(double, Random&)>& stamp_s) {
  Random random(seed);
  std::vector<StreamFrame> frames;
  for (int k = 0; k < 3000; ++k) {
    const double time_s = 1000 + k / 9.93;
    frames.push_back({time_s, {.observed_ns = std::llround(stamp_s(time_s, random) * 1e9)}});
  }
  FrameClock clock(10, 0);
  StreamScores scores;
  scores.run(clock, frames);
  EXPECT_FALSE(scores.backwards);
  return scores.steady;
}

TEST(IrregularStream, TheClaimHoldsRoundedAndTwoSidedStamps) {
  for (const double step_s : {1e-3, 10e-3}) {
    EXPECT_GT(spoilt(1, [&](double t, Random&) { return std::floor(t / step_s) * step_s; }).coverage(), 0.93);
    EXPECT_GT(spoilt(1, [&](double t, Random&) { return std::ceil(t / step_s) * step_s; }).coverage(), 0.93);
  }
  std::normal_distribution<double> normal(0, 5e-3);
  EXPECT_GT(spoilt(1, [&](double t, Random& random) { return t + normal(random); }).coverage(), 0.93);
}

}  // namespace
}  // namespace navcal::instruments
