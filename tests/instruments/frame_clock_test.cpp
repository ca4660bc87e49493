// SPDX-License-Identifier: Apache-2.0
#include "instruments/frame_clock.h"

#include <gtest/gtest.h>

#include <random>

#include "base/durations.h"
#include "tests/instruments/clock_simulation.h"

namespace navcal::instruments {
namespace {

FrameObservation at(double time_s, std::optional<int> sequence = std::nullopt) {
  FrameObservation frame;
  frame.observed_ns = std::llround(time_s * 1e9);
  if (sequence) frame.sequence = static_cast<std::uint8_t>(*sequence);
  return frame;
}

TEST(FrameClock, WithoutARateArrivalIsAllThereIs) {
  FrameClock clock(0, 0.01);
  const auto outcome = clock.update(at(5.0));
  EXPECT_EQ(outcome.time.time_ns, 5'000'000'000);
  EXPECT_GE(outcome.time.std_ns, 10 * base::kMillisecond_ns);
  EXPECT_FALSE(clock.state().locked);
}

TEST(FrameClock, CountsLostFramesBySequence) {
  FrameClock clock(20, 0);
  SimulatedDevice device({}, 1);
  for (int k = 0; k < 2000; ++k) {
    const auto frame = device.next();
    if (k % 100 == 50 || k % 100 == 51) continue;  // two in a hundred never come
    const auto outcome = clock.update(at(frame.arrival_s, k % 256));
    EXPECT_NEAR(static_cast<double>(outcome.time.time_ns) * 1e-9, frame.true_s, k < 40 ? 5e-3 : 5e-4) << k;
  }
  EXPECT_EQ(clock.lost(), 40U);
  EXPECT_EQ(clock.repeated(), 0U);
}

TEST(FrameClock, ALongOutageWrapsTheCounterAndIsCountedWhole) {
  FrameClock clock(20, 0);
  int k = 0;
  for (; k < 100; ++k) clock.update(at(10 + 0.05 * k, k % 256));
  k += 700;  // 35 s: nearly three turns of the counter
  FrameObservation first = at(10 + 0.05 * k, k % 256);
  clock.update(first);
  EXPECT_EQ(clock.lost(), 700U);
}

TEST(FrameClock, ARepeatedFrameIsNoNewTick) {
  FrameClock clock(20, 0);
  for (int k = 0; k < 50; ++k) {
    clock.update(at(10 + 0.05 * k, k));
    if (k == 20) {
      EXPECT_TRUE(clock.update(at(10 + 0.05 * k + 0.003, k)).repeated);
    }
  }
  EXPECT_EQ(clock.repeated(), 1U);
  EXPECT_EQ(clock.lost(), 0U);
}

TEST(FrameClock, ARestartOfTheDeviceIsNoLossOfFrames) {
  FrameClock clock(20, 0);
  for (int k = 0; k < 200; ++k) clock.update(at(10 + 0.05 * k, k));
  // Power cycle: 2.013 s later it begins with 0 again, at another phase.
  double t = 10 + 0.05 * 199 + 2.013;
  for (int k = 0; k < 100; ++k, t += 0.05) {
    const auto outcome = clock.update(at(t, k));
    EXPECT_LT(std::abs(static_cast<double>(outcome.time.time_ns) * 1e-9 - t), 4e-3) << k;
  }
  EXPECT_EQ(clock.lost(), 0U);
  EXPECT_GE(clock.state().resets, 1U);
}

TEST(FrameClock, WithoutASequenceALostFrameShowsInTime) {
  FrameClock clock(10, 0);
  for (int k = 0; k < 400; ++k) {
    if (k == 300 || k == 301) continue;
    clock.update(at(10 + 0.1 * k + 1e-4 * (k % 7)));
  }
  EXPECT_EQ(clock.lost(), 2U);
}

TEST(FrameClock, WithoutASequenceABacklogIsNoLoss) {
  FrameClock clock(10, 0);
  for (int k = 0; k < 300; ++k) clock.update(at(10 + 0.1 * k));
  // The host slept for half a second: five frames lie in one read.
  for (int k = 300; k < 305; ++k) {
    auto frame = at(10 + 0.1 * 304 + 0.001);
    frame.backlog = k < 304;
    const auto outcome = clock.update(frame);
    EXPECT_NEAR(static_cast<double>(outcome.time.time_ns) * 1e-9, 10 + 0.1 * k, 1e-3) << k;
  }
  EXPECT_EQ(clock.lost(), 0U);
}

TEST(FrameClock, LearnsARateThatIsNotTheConfiguredOne) {
  for (const double rate_Hz : {5.0, 20.0}) {
    FrameClock clock(10, 0);
    for (int k = 0; k < 200; ++k) clock.update(at(10 + k / rate_Hz));
    EXPECT_NEAR(clock.state().period_s, 1 / rate_Hz, 1e-3 / rate_Hz);
  }
}

// A machine's load comes and goes: mean delays between 0.1 and 40 ms for a third of a second to three seconds
// each. Late frames at one end of a run tilt the line through it by some per cent.
TEST(FrameClock, ALoadThatComesAndGoesIsNoOtherRate) {
  constexpr double kPeriod_s = 0.05;
  int locked = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    FrameClock clock(20, 0);
    double mean_s = 0, until_s = 0, arrival_s = 0;
    for (int k = 0; k < 200; ++k) {
      if (k * kPeriod_s >= until_s) {
        until_s = k * kPeriod_s + 0.3 * std::pow(10, share(random));
        mean_s = 1e-4 * std::pow(10, 2.6 * share(random));
      }
      arrival_s = std::max(arrival_s + 1e-4, k * kPeriod_s - mean_s * std::log1p(-share(random)));
      clock.update(at(10 + arrival_s, k));
      if (!clock.state().locked) continue;
      ++locked;
      ASSERT_NEAR(clock.state().period_s, kPeriod_s, 0.01 * kPeriod_s) << "seed " << seed << ", frame " << k;
    }
  }
  EXPECT_GT(locked, 100'000);
}

TEST(FrameClock, AnotherRateIsFoundInARunOfUnevenDelaysToo) {
  std::mt19937_64 random(3);
  std::exponential_distribution<double> delay_s(1 / 3e-3);
  FrameClock clock(20, 0);
  for (int k = 0; k < 128; ++k) clock.update(at(10 + k * 0.0505 + delay_s(random), k));
  EXPECT_TRUE(clock.state().locked);
  EXPECT_NEAR(clock.state().period_s, 0.0505, 1e-4);
}

}  // namespace
}  // namespace navcal::instruments
