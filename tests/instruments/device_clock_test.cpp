// SPDX-License-Identifier: Apache-2.0
#include "instruments/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "instruments/frame_clock.h"

namespace navcal::instruments {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

/// A device whose clock began at a time of its own and runs `ppm` too fast, read by a host with exponential
/// delays.
class ClockedDevice {
 public:
  explicit ClockedDevice(double ppm, double mean_delay_s = 1e-3)
      : rate_(1 + ppm * 1e-6), delay_(1 / mean_delay_s) {}

  [[nodiscard]] FrameObservation frame_at(std::int64_t true_ns) {
    FrameObservation frame;
    frame.observed_ns = true_ns + std::llround(delay_(random_) * 1e9);
    frame.device_time_ns = device_began_ns + std::llround(static_cast<double>(true_ns) * rate_);
    return frame;
  }
  std::int64_t device_began_ns = 282'809'000'000;

 private:
  double rate_;
  std::mt19937_64 random_{7};
  std::exponential_distribution<double> delay_;
};

TEST(DeviceClock, UnevenFramesHaveTheTimesOfTheDevice) {
  for (const double ppm : {-200.0, 0.0, 150.0}) {
    ClockedDevice device(ppm);
    FrameClock clock(100, 0);
    std::mt19937 random(3);
    std::int64_t true_ns = 0;
    double squares = 0, normalised = 0;
    int counted = 0;
    for (int i = 0; i < 6000; ++i) {
      true_ns += (1 + static_cast<std::int64_t>(random() % 19)) * kMillisecond;
      const auto outcome = clock.update(device.frame_at(true_ns));
      if (i < 1000) continue;
      const double error_s = static_cast<double>(outcome.time.time_ns - true_ns) * 1e-9;
      const double std_s = static_cast<double>(outcome.time.std_ns) * 1e-9;
      squares += error_s * error_s;
      normalised += error_s * error_s / (std_s * std_s);
      ++counted;
    }
    EXPECT_LT(std::sqrt(squares / counted), 100e-6) << "delays have a mean of 1 ms; ppm " << ppm;
    EXPECT_LT(normalised / counted, 4) << ppm;
    EXPECT_EQ(clock.state().timing, Timing::device);
    EXPECT_TRUE(clock.state().locked);
    EXPECT_NEAR(clock.state().skew_ppm, -ppm, 20);
    EXPECT_EQ(clock.lost(), 0U) << "frames at uneven intervals have no period to be lost from";
  }
}

TEST(DeviceClock, LostFramesAreCountedInTheDevicesTime) {
  ClockedDevice device(30);
  FrameClock clock(100, 0);
  std::uint64_t lost = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool missing = i > 50 && i < 2900 && i % 97 < 3;
    lost += missing ? 1 : 0;
    if (!missing) clock.update(device.frame_at(i * 10 * kMillisecond));
  }
  EXPECT_GT(lost, 80U);
  EXPECT_EQ(clock.lost(), lost);
}

TEST(DeviceClock, AnotherRateIsNoLossAndIsReportedOnce) {
  ClockedDevice device(0);
  FrameClock clock(100, 0);
  int news = 0;
  for (int i = 0; i < 500; ++i) news += clock.update(device.frame_at(i * 25 * kMillisecond)).news ? 1 : 0;
  EXPECT_EQ(clock.lost(), 0U);
  EXPECT_EQ(news, 1);
  EXPECT_NEAR(clock.state().period_s, 0.025, 1e-5);
}

TEST(DeviceClock, ARepeatedFrameIsNoNewTick) {
  ClockedDevice device(0);
  FrameClock clock(100, 0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(clock.update(device.frame_at(i * 10 * kMillisecond)).repeated);
    EXPECT_TRUE(clock.update(device.frame_at(i * 10 * kMillisecond)).repeated);
  }
  EXPECT_EQ(clock.repeated(), 100U);
}

TEST(DeviceClock, AFrameThatDoesNotPaceHasItsOwnTime) {
  ClockedDevice device(80);
  FrameClock clock(100, 0);
  for (int i = 0; i < 2000; ++i) {
    clock.update(device.frame_at(i * 10 * kMillisecond));
    if (i % 5 != 0) continue;
    // Its time is that of the tick before: the device's filter is slower than its sensors.
    FrameObservation other = device.frame_at((i - 1) * 10 * kMillisecond);
    other.observed_ns += 12 * kMillisecond;
    other.paces = false;
    const auto outcome = clock.update(other);
    if (i > 500) {
      EXPECT_NEAR(static_cast<double>(outcome.time.time_ns - (i - 1) * 10 * kMillisecond), 0, 300e3);
    }
  }
  EXPECT_EQ(clock.lost(), 0U);
  EXPECT_EQ(clock.repeated(), 0U);
}

TEST(DeviceClock, ARestartOfTheDeviceBeginsTheFitAnew) {
  ClockedDevice device(0);
  FrameClock clock(100, 0);
  std::int64_t true_ns = 0;
  std::int64_t before_ns = 0;
  for (int i = 0; i < 1000; ++i) clock.update(device.frame_at(true_ns += 10 * kMillisecond));
  device.device_began_ns = -true_ns;
  true_ns += 700 * kMillisecond;
  for (int i = 0; i < 1000; ++i) {
    const auto outcome = clock.update(device.frame_at(true_ns += 10 * kMillisecond));
    EXPECT_GT(outcome.time.time_ns, before_ns);
    before_ns = outcome.time.time_ns;
    EXPECT_NEAR(static_cast<double>(outcome.time.time_ns - true_ns), 0, 15e6);
  }
  EXPECT_EQ(clock.state().resets, 1U);
  EXPECT_EQ(clock.lost(), 0U);
}

TEST(DeviceClock, ADeviceThatCeasesToStateItsTimeIsPacedAgain) {
  ClockedDevice device(0);
  FrameClock clock(100, 0);
  std::int64_t true_ns = 0;
  for (int i = 0; i < 200; ++i) clock.update(device.frame_at(true_ns += 10 * kMillisecond));
  for (int i = 0; i < 300; ++i) {
    FrameObservation frame = device.frame_at(true_ns += 10 * kMillisecond);
    frame.device_time_ns.reset();
    clock.update(frame);
  }
  EXPECT_EQ(clock.state().timing, Timing::periodic);
}

}  // namespace
}  // namespace navcal::instruments
