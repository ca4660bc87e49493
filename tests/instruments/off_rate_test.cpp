// SPDX-License-Identifier: Apache-2.0
// Instruments that run off their nominal rate: errors of the stamps, and what is claimed of them.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/instruments/frame_stream.h"

namespace navcal::instruments {
namespace {

/// All rates that an instrument may have, thinned out; bench/timing does every tenth of a per cent.
std::vector<double> factors() {
  std::vector<double> all;
  for (int i = 0; i <= 30; ++i) all.push_back(0.5 + 0.05 * i + 0.001 * (i % 5));
  all.insert(all.end(), {0.94, 0.98, 0.99, 0.995, 0.999, 1.001, 1.01});
  return all;
}

class OffRateCell : public testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(OffRateCell, IsTenTimesBetterThanArrivalAndSaysHowGoodItIs) {
  StreamOptions options;
  options.jitter_s = std::get<0>(GetParam());
  options.counted = std::get<1>(GetParam());
  StreamScore first, learning, steady;
  unsigned seed = 100;
  for (const double factor : factors()) {
    options.factor = factor;
    StreamScores scores;
    for (int run = 0; run < 4; ++run) {
      FrameClock clock(options.nominal_Hz, 0);
      scores.run(clock, make_stream(options, ++seed, 2000));
      EXPECT_EQ(clock.state().timing, Timing::periodic) << factor;
      EXPECT_NEAR(clock.state().period_s * options.nominal_Hz * factor, 1, 3e-4) << factor;
    }
    EXPECT_FALSE(scores.backwards) << factor;
    EXPECT_LT(scores.steady.ratio(), 0.1) << factor;
    EXPECT_GT(scores.steady.coverage(), 0.85) << factor;
    first.add(scores.first);
    learning.add(scores.learning);
    steady.add(scores.steady);
  }
  EXPECT_GT(first.coverage(), 0.95);
  EXPECT_GT(learning.coverage(), 0.95);
  EXPECT_GT(steady.coverage(), 0.93);
  EXPECT_LT(steady.coverage(), 0.98);
}

INSTANTIATE_TEST_SUITE_P(Cells, OffRateCell,
                         testing::Combine(testing::Values(0.2e-3, 2e-3, 8e-3), testing::Bool()));

TEST(OffRate, LongStallsDoNotMoveTheClock) {
  for (const bool counted : {false, true}) {
    StreamOptions options;
    options.factor = 0.99;
    options.stall_s = 0.7;
    options.counted = counted;
    StreamScores scores;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      FrameClock clock(options.nominal_Hz, 0);
      auto frames = make_stream(options, seed, 2000);
      frames.resize(frames.size() - 10);  // a stall at the very end has nothing behind it that would show it
      scores.run(clock, frames);
    }
    EXPECT_LT(scores.steady.ratio(), 0.25) << counted;
    EXPECT_GT(scores.steady.coverage(), 0.93) << counted;
  }
}

/// News of a stream, in order.
std::vector<ClockNews> news_of(FrameClock& clock, const std::vector<StreamFrame>& frames) {
  std::vector<ClockNews> news;
  for (const StreamFrame& frame : frames) {
    if (const auto outcome = clock.update(frame.observation); outcome.news) news.push_back(*outcome.news);
  }
  return news;
}

TEST(OffRate, ARateThatDiffersIsToldOnce) {
  for (const bool counted : {false, true}) {
    for (const double factor : {0.5, 0.94, 0.99, 1.01, 2.0}) {
      StreamOptions options;
      options.factor = factor;
      options.counted = counted;
      FrameClock clock(options.nominal_Hz, 0);
      EXPECT_EQ(news_of(clock, make_stream(options, 5, 3000)), std::vector{ClockNews::rate}) << factor << counted;
    }
    for (const double factor : {0.998, 1.0, 1.002}) {
      StreamOptions options;
      options.factor = factor;
      options.counted = counted;
      FrameClock clock(options.nominal_Hz, 0);
      EXPECT_TRUE(news_of(clock, make_stream(options, 6, 3000)).empty()) << factor << counted;
    }
  }
}

TEST(OffRate, AChangeOfTheRateIsFollowed) {
  for (const bool counted : {false, true}) {
    for (const double later_Hz : {5.0, 8.0, 9.5, 9.9, 10.1, 20.0}) {
      std::vector<StreamFrame> frames;
      double time_s = 1000;
      for (int k = 0; k < 1200; ++k) {
        StreamFrame frame{time_s, {.observed_ns = std::llround(time_s * 1e9) + (k * 7919 % 1000) * 1000}};
        if (counted) frame.observation.sequence = static_cast<std::uint8_t>(k);
        frames.push_back(frame);
        time_s += 1 / (k < 600 ? 10.0 : later_Hz);
      }
      FrameClock clock(10, 0);
      StreamScore late;
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const auto outcome = clock.update(frames[k].observation);
        if (k >= 800) late.add(frames[k], outcome.time);
      }
      EXPECT_LT(late.rms_s(), 1e-3) << later_Hz << counted;
      EXPECT_GT(late.coverage(), 0.9) << later_Hz << counted;
      EXPECT_NEAR(clock.state().period_s * later_Hz, 1, 2e-3) << later_Hz << counted;
    }
  }
}

}  // namespace
}  // namespace navcal::instruments
