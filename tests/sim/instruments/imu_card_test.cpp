// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/imu_card.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

ImuCard::Options exact() {
  ImuCard::Options options;
  options.rate_noise_deg_s = options.turn_on_bias_deg_s = options.force_noise_m_s2 = options.depth_noise_m = 0;
  return options;
}

TEST(EmulatedImuCard, StillAndLevelReadsZerosAndMinusOneG) {
  const Still motion;
  ImuCard card(exact(), motion);
  card.power_on(kStart_ns);
  const auto frames = run_to(card, kStart_ns + kSecond_ns);
  ASSERT_EQ(frames.size(), 20U);
  const auto record = protocols::imu_card::decode_record(frames[0].bytes);
  ASSERT_TRUE(record);
  const std::array<std::uint16_t, 8> expected{32768, 32768, 32768, 32768, 32768, 32768, 16768, 4000};
  EXPECT_EQ(record->raw, expected);
  EXPECT_EQ(record->status, 0);
}

TEST(EmulatedImuCard, EveryChannelHasItsScale) {
  Still motion;
  motion.state.rate_rad_s = {0.1, -0.2, 0.3};
  motion.state.specific_force_m_s2 = {kGravity_m_s2 / 2, 0, 0};
  motion.state.position_m[2] = 4;
  ImuCard card(exact(), motion);
  card.power_on(kStart_ns);
  const auto record = protocols::imu_card::decode_record(run_to(card, kStart_ns + kSecond_ns)[0].bytes);
  const auto count = [](double zero_mV, double mV) {
    return static_cast<std::uint16_t>(std::lround(16 * (zero_mV + mV)));
  };
  const double degrees = 180 / std::numbers::pi;
  EXPECT_EQ(record->raw[0], count(2048, 10 * 0.1 * degrees));
  EXPECT_EQ(record->raw[1], count(2048, 10 * 0.3 * degrees));
  EXPECT_EQ(record->raw[2], count(2048, 10 * -0.2 * degrees));
  EXPECT_EQ(record->raw[3], count(2048, 10 * 0.3 * degrees));
  EXPECT_EQ(record->raw[4], count(2048, 500));
  EXPECT_EQ(record->raw[7], count(250, 4 * 187.5));
}

TEST(EmulatedImuCard, ItsClockRunsAtItsOwnRateWithoutAccumulatingRounding) {
  const Still motion;
  ImuCard::Options options = exact();
  options.clock_ppm = 150;
  ImuCard card(options, motion);
  card.power_on(kStart_ns);
  const auto frames = run_to(card, kStart_ns + 1000 * kSecond_ns);
  ASSERT_EQ(frames.size(), 19997U);  // 20000 / 1.00015
  const double elapsed_s = static_cast<double>(frames.back().start_ns - frames.front().start_ns) * 1e-9;
  EXPECT_NEAR(elapsed_s, 19996 * 0.05 * 1.00015, 1e-8);
}

TEST(EmulatedImuCard, SequenceWrapsAndBeginsAnewWithThePower) {
  const Still motion;
  ImuCard card(exact(), motion);
  card.power_on(kStart_ns);
  const auto frames = run_to(card, kStart_ns + 15 * kSecond_ns);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_EQ(protocols::imu_card::decode_record(frames[i].bytes)->sequence, static_cast<std::uint8_t>(i));
  }
  card.power_on(kStart_ns + 16 * kSecond_ns);
  EXPECT_EQ(protocols::imu_card::decode_record(run_to(card, kStart_ns + 17 * kSecond_ns)[0].bytes)->sequence, 0);
}

TEST(EmulatedImuCard, OverRangeAndLeaksAreFlagged) {
  Still motion;
  motion.state.rate_rad_s[2] = 10;  // 573 deg/s are far beyond the converter
  ImuCard card(exact(), motion);
  card.power_on(kStart_ns);
  card.set_status(protocols::imu_card::leak_aft);
  const auto record = protocols::imu_card::decode_record(run_to(card, kStart_ns + kSecond_ns)[0].bytes);
  EXPECT_EQ(record->status, protocols::imu_card::leak_aft | protocols::imu_card::over_range);
  EXPECT_EQ(record->raw[1], 65520);
}

TEST(EmulatedImuCard, NoiseAndTurnOnBiasAreOfTheStatedSize) {
  const Still motion;
  ImuCard::Options options;
  double sum2 = 0, bias2 = 0;
  constexpr int kPowerOns = 400;
  ImuCard card(options, motion);
  std::int64_t t = kStart_ns;
  for (int i = 0; i < kPowerOns; ++i) {
    card.power_on(t);
    const auto frames = run_to(card, t + kSecond_ns);
    double mean = 0;
    std::vector<double> rates;
    for (const auto& frame : frames)
      rates.push_back((protocols::imu_card::decode_record(frame.bytes)->raw[1] / 16.0 - 2048) / 10);
    for (const double rate : rates) mean += rate / static_cast<double>(rates.size());
    for (const double rate : rates)
      sum2 += (rate - mean) * (rate - mean) / (static_cast<double>(rates.size()) - 1);
    bias2 += mean * mean;
    t += 2 * kSecond_ns;
  }
  EXPECT_NEAR(std::sqrt(sum2 / kPowerOns), 0.1, 0.01);
  EXPECT_NEAR(std::sqrt(bias2 / kPowerOns), 0.3, 0.05);
}

}  // namespace
}  // namespace navcal::sim::testing
