// SPDX-License-Identifier: Apache-2.0
// Times of validity of an autopilot's samples through a network that delays its frames by 1 to 21 ms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "config/load.h"
#include "pipeline/pipeline.h"
#include "protocols/mavlink.h"

namespace navcal::pipeline {
namespace {

namespace mavlink = protocols::mavlink;

constexpr std::int64_t kStart_ns = 100'000'000'000, kPeriod_ns = 20'000'000;
constexpr double kFast = 1 + 30e-6;
constexpr int kTicks = 6000, kSettled = 1000;

/// Errors of the samples of one kind, of which each holds the number of its tick.
struct Errors {
  double sum_s2 = 0, arrival_s2 = 0;
  int samples = 0, within = 0;

  void add(const instruments::Stamp& stamp, int tick) {
    if (tick < kSettled) return;
    const std::int64_t true_ns = kStart_ns + tick * kPeriod_ns;
    const double late_s = 1e-9 * static_cast<double>(stamp.validity_ns - true_ns);
    sum_s2 += late_s * late_s;
    arrival_s2 += std::pow(1e-9 * static_cast<double>(stamp.arrival_ns - true_ns), 2);
    within += std::abs(late_s) < 2e-9 * static_cast<double>(stamp.std_ns) ? 1 : 0;
    ++samples;
  }
  [[nodiscard]] double rms_ms() const { return 1e3 * std::sqrt(sum_s2 / samples); }
  [[nodiscard]] double arrival_ms() const { return 1e3 * std::sqrt(arrival_s2 / samples); }
};

struct Keeper : Sink {
  Errors imu, altimeter;
  int imus = 0;
  void on_sample(const instruments::Sample& sample) override {
    if (const auto* value = std::get_if<instruments::ImuSample>(&sample.value)) {
      ++imus;
      imu.add(sample.stamp, static_cast<int>(std::lround((*value->rate_rad_s)[0] * 1e3)));
    }
    if (const auto* value = std::get_if<instruments::AltimeterSample>(&sample.value))
      altimeter.add(sample.stamp, static_cast<int>(std::lround(value->altitude_m * 100)));
  }
};

template <class... Numbers>
std::vector<std::uint8_t> frame(std::uint32_t id, std::uint8_t component, Numbers... numbers) {
  std::vector<std::uint8_t> payload;
  const auto put = [&](auto number) {
    payload.resize(payload.size() + sizeof number);
    protocols::put_le(payload.data() + payload.size() - sizeof number, number);
  };
  (put(numbers), ...);
  return mavlink::encode(id, {1, component, 0}, payload);
}

TEST(MavlinkClock, StampsByTheClocksOfTheVehicle) {
  config::Settings settings;
  settings.ports.push_back(config::default_port("rov", protocols::Protocol::mavlink, 4'000'000));
  Pipeline pipeline(settings);
  Keeper keeper;
  std::mt19937_64 random(5);
  std::uniform_int_distribution<std::int64_t> delay_ns(1'000'000, 21'000'000);
  std::int64_t arrival_ns = kStart_ns;
  const auto i16 = [](int value) { return static_cast<std::int16_t>(value); };
  const auto u16 = [](int value) { return static_cast<std::uint16_t>(value); };
  for (int tick = 0; tick < kTicks; ++tick) {
    const auto since_us = static_cast<std::uint64_t>(tick * kPeriod_ns * kFast / 1000);
    arrival_ns = std::max(arrival_ns, kStart_ns + tick * kPeriod_ns + delay_ns(random));
    const auto send = [&](const std::vector<std::uint8_t>& bytes) {
      pipeline.bytes(0, arrival_ns, bytes, keeper);
    };
    if (tick % 50 == 0) send(frame(0, 1, std::uint32_t{0}, std::uint8_t{12}, std::uint8_t{3}));
    send(frame(27, 1, since_us + 3'600'000'000, i16(0), i16(0), i16(-1000), i16(tick), i16(0), i16(0)));
    if (tick % 5 != 0) continue;
    const auto echo_ms = static_cast<std::uint32_t>(since_us / 1000 + 77'000);
    send(frame(132, 194, echo_ms, u16(30), u16(60'000), u16(tick), u16(0), std::uint8_t{25}));
  }
  EXPECT_EQ(keeper.imus, kTicks);
  EXPECT_GT(keeper.altimeter.samples, 500);
  RecordProperty("imu_rms_us", static_cast<int>(1e3 * keeper.imu.rms_ms()));
  RecordProperty("altimeter_rms_us", static_cast<int>(1e3 * keeper.altimeter.rms_ms()));
  std::printf("rms: IMU %.2f ms, altimeter %.2f ms, arrival %.2f ms; within two standard errors %.1f %%\n",
              keeper.imu.rms_ms(), keeper.altimeter.rms_ms(), keeper.imu.arrival_ms(),
              100.0 * keeper.imu.within / keeper.imu.samples);
  EXPECT_GT(keeper.imu.arrival_ms(), 11);
  EXPECT_LT(keeper.imu.rms_ms(), 2);
  EXPECT_LT(keeper.altimeter.rms_ms(), 3);
  EXPECT_GT(keeper.imu.within, 0.9 * keeper.imu.samples);
}

}  // namespace
}  // namespace navcal::pipeline
