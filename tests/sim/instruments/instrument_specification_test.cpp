// SPDX-License-Identifier: Apache-2.0
// Noise, resolution and latency of each instrument against docs/simulator.md, through its own frames.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_position.h"
#include "protocols/tcm2_word.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"
#include "sim/rotation.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

/// Sample variance over what it should be: chi-square over its degrees of freedom, here within five of its
/// standard deviations, which no seed passes by chance and a sigma wrong by a tenth does not.
void expect_variance(const std::vector<double>& values, double expected, const std::string& what) {
  double mean = 0, square = 0;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean) / (count - 1);
  EXPECT_NEAR(square / expected, 1, 5 * std::sqrt(2 / (count - 1))) << what;
}

void expect_sigma(const std::vector<double>& values, double sigma, double resolution, const std::string& what) {
  // Rounding to a step adds the variance of what it cuts off.
  expect_variance(values, sigma * sigma + resolution * resolution / 12, what);
  for (const double value : values) {
    ASSERT_NEAR(std::remainder(value, resolution), 0, 1e-6 * std::max(1.0, std::abs(value))) << what;
  }
}

Tcm2::Options words() {
  Tcm2::Options options;
  options.go_at_power_on = options.field_at_power_on = true;
  return options;
}

constexpr int kSeconds = 200;

TEST(InstrumentSpecification, CompassNoise) {
  Still motion;
  motion.state.water_temperature_C = 7;  // so that the electronics have settled at 15
  Tcm2::Options options = words();
  Tcm2 compass(options, motion);
  compass.power_on(kStart_ns - 4000 * kSecond_ns);
  run_to(compass, kStart_ns);
  std::vector<double> x, y, z, pitch, roll, temperature;
  for (const auto& frame : run_to(compass, kStart_ns + kSeconds * kSecond_ns)) {
    const auto word = protocols::tcm2::decode_word(frame.bytes);
    if (!word) continue;
    x.push_back(*word->x);
    y.push_back(*word->y);
    z.push_back(*word->z);
    pitch.push_back(*word->pitch);
    roll.push_back(*word->roll);
    temperature.push_back(*word->temperature);
  }
  ASSERT_EQ(x.size(), 10U * kSeconds);
  expect_sigma(x, 0.15, 0.01, "x");
  expect_sigma(y, 0.15, 0.01, "y");
  expect_sigma(z, 0.15, 0.01, "z");
  expect_sigma(pitch, 0.1, 0.1, "pitch");
  expect_sigma(roll, 0.1, 0.1, "roll");
  expect_sigma(temperature, 0.1, 0.1, "temperature");
}

TEST(InstrumentSpecification, CardNoise) {
  const Still motion;
  ImuCard card({}, motion);
  card.power_on(kStart_ns);
  std::array<std::vector<double>, 8> channels;
  for (const auto& frame : run_to(card, kStart_ns + kSeconds * kSecond_ns)) {
    const auto record = protocols::imu_card::decode_record(frame.bytes);
    for (std::size_t i = 0; i < 8; ++i) channels[i].push_back(record->raw[i] / 16.0);
  }
  ASSERT_EQ(channels[0].size(), 20U * kSeconds);
  for (std::size_t i = 0; i < 4; ++i) expect_sigma(channels[i], 0.1 * 10, 1 / 16.0, "gyro, mV");
  for (std::size_t i = 4; i < 7; ++i) {
    expect_sigma(channels[i], 0.02 / kGravity_m_s2 * 1000, 1 / 16.0, "accelerometer, mV");
  }
  expect_sigma(channels[7], 0.02 * 187.5, 1 / 16.0, "depth, mV");
}

TEST(InstrumentSpecification, MotorCardNoise) {
  Still motion;
  motion.state.rpm = 700.4;
  motion.state.fins_rad = {0.1, -0.2, 0};
  motion.state.motor_current_A = 1.23;
  MotorCard card({}, motion);
  card.power_on(kStart_ns);
  std::vector<double> fin, current;
  for (const auto& frame : run_to(card, kStart_ns + kSeconds * kSecond_ns)) {
    const auto status = protocols::motor_card::decode_status(frame.bytes);
    EXPECT_EQ(*status->rpm, 700);
    fin.push_back(*status->fins_deg[1]);
    current.push_back(*status->current_A);
  }
  expect_sigma(fin, 0.1, 0.1, "fin");
  expect_sigma(current, 0.02, 0.01, "current");
}

TEST(InstrumentSpecification, EachPowerOnGivesTheGyrosAnotherBias) {
  const Still motion;
  std::array<std::vector<double>, 4> biases_deg_s;
  constexpr int kPowerOns = 1000, kSamples = 20;
  for (int i = 0; i < kPowerOns; ++i) {
    ImuCard::Options options;
    options.seed = static_cast<std::uint64_t>(i) + 1;
    ImuCard card(options, motion);
    card.power_on(kStart_ns);
    std::array<double, 4> sum{};
    int taken = 0;
    for (const auto& frame : run_to(card, kStart_ns + 2 * kSecond_ns)) {
      if (taken == kSamples) break;
      const auto record = protocols::imu_card::decode_record(frame.bytes);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += record->raw[k] / 16.0 / 10;  // 10 mV for a degree a second
      ++taken;
    }
    ASSERT_EQ(taken, kSamples);
    for (std::size_t k = 0; k < 4; ++k) biases_deg_s[k].push_back(sum[k] / kSamples);
  }
  for (const auto& biases : biases_deg_s)
    expect_variance(biases, 0.3 * 0.3 + 0.1 * 0.1 / kSamples, "turn-on bias");
}

TEST(InstrumentSpecification, SettledFixesHaveTheirNoiseInPositionAndVelocity) {
  Still motion;
  motion.state.velocity_body_m_s = {1.2, 0, 0};
  motion.state.euler_rad = {0, 0, 0.7};
  GpsReceiver receiver({}, motion, 5);
  receiver.power_on(kStart_ns);
  const Origin origin;
  const Vector3 one_m = geodetic(origin, {1, 1, 0});
  std::vector<double> north_m, east_m, north_m_s, east_m_s;
  constexpr int kToSettle = 60;
  for (int second = 1; second <= kToSettle + 2000; ++second) {
    const GpsReading reading = receiver.measure(kStart_ns + second * kSecond_ns);
    if (second <= kToSettle) continue;
    north_m.push_back((reading.latitude_deg - origin.latitude_deg) / (one_m[0] - origin.latitude_deg));
    east_m.push_back((reading.longitude_deg - origin.longitude_deg) / (one_m[1] - origin.longitude_deg));
    const double course = reading.course_deg * std::numbers::pi / 180;
    north_m_s.push_back(reading.speed_m_s * std::cos(course));
    east_m_s.push_back(reading.speed_m_s * std::sin(course));
  }
  expect_variance(north_m, 1, "north");
  expect_variance(east_m, 1, "east");
  expect_variance(north_m_s, 0.01, "velocity north");
  expect_variance(east_m_s, 0.01, "velocity east");
}

TEST(InstrumentSpecification, FirstFixesAreDegradedAndSaySo) {
  const Still motion;
  double first = 0, settled = 0;
  constexpr int kPowerOns = 400;
  for (int i = 0; i < kPowerOns; ++i) {
    GpsReceiver receiver({}, motion, static_cast<std::uint64_t>(i) + 1);
    receiver.power_on(kStart_ns);
    int fixes = 0;
    for (int second = 1; second <= 40; ++second) {
      const GpsReading reading = receiver.measure(kStart_ns + second * kSecond_ns);
      if (!reading.fixed) {
        EXPECT_LE(second, 10);
        continue;
      }
      const double height = reading.height_m - Origin{}.height_m;
      if (fixes == 0) {
        EXPECT_GE(second, 2);
        EXPECT_EQ(reading.degraded, 3);
        first += height * height / kPowerOns;
      }
      if (++fixes == 28) {
        EXPECT_NEAR(reading.degraded, 1, 1e-6);
        settled += height * height / kPowerOns;
      }
    }
    EXPECT_GE(fixes, 28);
  }
  EXPECT_NEAR(first / 9, 1, 5 * std::sqrt(2.0 / kPowerOns));
  EXPECT_NEAR(settled, 1, 5 * std::sqrt(2.0 / kPowerOns));
}

/// Remembers for which time it was asked last; of the future only the water's temperature is asked.
struct Asked final : Motion {
  mutable std::int64_t last_ns = 0, now_ns = 0;
  [[nodiscard]] State at(std::int64_t t_ns) const override {
    if (t_ns <= now_ns) last_ns = t_ns;
    return {};
  }
};

void expect_latency(Device& device, const Asked& motion, std::int64_t latency_ns, int frames) {
  std::vector<Emission> out;
  for (int seen = 0; seen < frames;) {
    out.clear();
    motion.now_ns = device.next_event_ns();
    device.advance(motion.now_ns, out);
    for (const Emission& emission : out) {
      if (emission.bytes.size() == 23) continue;  // the compass's banner measures nothing
      EXPECT_EQ(emission.start_ns - motion.last_ns, latency_ns);
      ++seen;
    }
  }
}

TEST(InstrumentSpecification, LatencyFromTheMeasurementToTheFirstByte) {
  const Asked motion;
  Tcm2 compass(words(), motion);
  compass.power_on(kStart_ns);
  expect_latency(compass, motion, 50'000'000, 20);
  ImuCard card({}, motion);
  card.power_on(kStart_ns);
  expect_latency(card, motion, 25'000'000, 20);
  MotorCard motor({}, motion);
  motor.power_on(kStart_ns);
  expect_latency(motor, motion, 5'000'000, 20);
  Oncore receiver({}, motion);
  receiver.power_on(kStart_ns);
  receiver.on_bytes(kStart_ns, protocols::oncore::encode_poll(protocols::oncore::kHa, 1));
  expect_latency(receiver, motion, 300'000'000, 20);
}

TEST(InstrumentSpecification, ElectronicsWarmUpFromTheWaterAndFollowIt) {
  struct Diving final : Motion {
    [[nodiscard]] State at(std::int64_t t_ns) const override {
      State state;
      const double t_s = static_cast<double>(t_ns - kStart_ns) * 1e-9;
      state.water_temperature_C = water_temperature_C(0.1 * t_s);
      return state;
    }
  } const motion;
  Electronics electronics;
  electronics.power_on(kStart_ns, motion);
  EXPECT_NEAR(electronics.temperature_C(kStart_ns, motion), 15, 1e-12);
  // T' = (15 - 0.025 t + 8 - T)/200 from T = 15.
  for (const double t_s : {0.5, 10.25, 100.0, 500.7}) {
    const double settled = 15 + 8 + 0.025 * 200;
    const double expected = settled - 0.025 * t_s + (15 - settled) * std::exp(-t_s / 200);
    const auto t_ns = kStart_ns + static_cast<std::int64_t>(t_s * 1e9);
    EXPECT_NEAR(electronics.temperature_C(t_ns, motion), expected, 1e-9);
    EXPECT_NEAR(electronics.temperature_C(t_ns - 50'000'000, motion), expected, 1e-2) << "a little back in time";
  }
}

}  // namespace
}  // namespace navcal::sim::testing
