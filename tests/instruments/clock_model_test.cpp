// SPDX-License-Identifier: Apache-2.0
#include "instruments/clock_model.h"

#include <gtest/gtest.h>

#include "tests/instruments/clock_simulation.h"

namespace navcal::instruments {
namespace {

struct Score {
  double rms_s = 0, arrival_rms_s = 0, coverage = 0;
};

Score run(const SimulatedDevice::Options& options, unsigned seeds, double duration_s) {
  double model = 0, arrival = 0;
  int covered = 0, count = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SimulatedDevice device(options, seed);
    ClockModel clock(1 / options.rate_Hz);
    for (int k = 0; k < static_cast<int>(duration_s * options.rate_Hz); ++k) {
      const auto frame = device.next();
      const auto time = clock.update(k, std::llround(frame.arrival_s * 1e9));
      const double error_s = static_cast<double>(time.time_ns) * 1e-9 - frame.true_s;
      model += error_s * error_s;
      arrival += (frame.arrival_s - frame.true_s) * (frame.arrival_s - frame.true_s);
      covered += std::abs(error_s) <= 2e-9 * static_cast<double>(time.std_ns) ? 1 : 0;
      ++count;
    }
  }
  return {std::sqrt(model / count), std::sqrt(arrival / count), static_cast<double>(covered) / count};
}

TEST(ClockModel, IsTenTimesBetterThanArrivalAndSaysHowGoodItIs) {
  for (const double rate_Hz : {10.0, 20.0, 50.0}) {
    for (const double wander : {0.0, 0.3e-6, 1e-6}) {
      SimulatedDevice::Options options;
      options.rate_Hz = rate_Hz;
      options.wander = wander;
      const Score score = run(options, 10, 300);
      EXPECT_LT(score.rms_s, 0.1 * score.arrival_rms_s) << rate_Hz << " Hz, wander " << wander;
      EXPECT_GT(score.coverage, 0.94) << rate_Hz << " Hz, wander " << wander;
    }
  }
}

TEST(ClockModel, NeverStampsLaterThanArrival) {
  SimulatedDevice device({}, 3);
  ClockModel clock(0.05);
  for (int k = 0; k < 5000; ++k) {
    const auto observed_ns = std::llround(device.next().arrival_s * 1e9);
    EXPECT_LE(clock.update(k, observed_ns).time_ns, observed_ns);
  }
}

TEST(ClockModel, FindsTheSkewOfTheDevice) {
  SimulatedDevice::Options options;
  options.wander = 0;
  options.skew = -150e-6;
  SimulatedDevice device(options, 5);
  ClockModel clock(0.05);
  for (int k = 0; k < 12000; ++k) clock.update(k, std::llround(device.next().arrival_s * 1e9));
  const ClockState state = clock.state();
  EXPECT_TRUE(state.locked);
  EXPECT_NEAR(state.skew_ppm, -150, 4 * state.skew_std_ppm);
  EXPECT_LT(state.skew_std_ppm, 10);
  EXPECT_NEAR(state.jitter_s, 2e-3, 1e-3);
}

TEST(ClockModel, FollowsAPauseOfTheDevice) {
  ClockModel clock(0.05);
  std::int64_t t = 1'000'000'000;
  int k = 0;
  for (; k < 200; ++k) clock.update(k, t += 50'000'000);
  t += 20'000'000;  // every frame is 20 ms later from now on
  for (const int end = k + 200; k < end; ++k) clock.update(k, t += 50'000'000);
  EXPECT_NEAR(static_cast<double>(clock.predict_ns(k - 1) - t), 0, 2e6);
}

TEST(ClockModel, IsDeterministic) {
  SimulatedDevice one({}, 9), two({}, 9);
  ClockModel a(0.05), b(0.05);
  for (int k = 0; k < 1000; ++k) {
    const auto x = a.update(k, std::llround(one.next().arrival_s * 1e9));
    const auto y = b.update(k, std::llround(two.next().arrival_s * 1e9));
    ASSERT_EQ(x.time_ns, y.time_ns);
    ASSERT_EQ(x.std_ns, y.std_ns);
  }
}

}  // namespace
}  // namespace navcal::instruments
