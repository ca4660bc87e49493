// SPDX-License-Identifier: Apache-2.0
// The simulated instruments follow the model that they are given (devices/instrument_model.h).
#include "devices/instrument_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"
#include "sim/recording.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

Tcm2Sensor::Options model_sensor_with(const devices::CompassModel& compass) {
  Tcm2Sensor::Options options;
  options.compass = compass;
  return options;
}

/// Readings ten times a second by one seed.
std::vector<Tcm2Reading> model_compass_readings(const devices::CompassModel& compass) {
  const Still motion;
  Tcm2Sensor sensor(model_sensor_with(compass), motion, 7);
  sensor.power_on(kStart_ns);
  std::vector<Tcm2Reading> readings;
  for (int i = 1; i <= 50; ++i) readings.push_back(sensor.measure(kStart_ns + i * kSecond_ns / 10));
  return readings;
}

TEST(SimulatedInstruments, TheCompassIsAsNoisyAsItsModelSays) {
  devices::CompassModel usual, noisy;
  noisy.field_noise_uT *= 3;
  noisy.tilt_noise_rad *= 5;
  noisy.temperature_noise_C *= 2;
  const auto exact = model_compass_readings(devices::without_noise({}).compass);
  const auto once = model_compass_readings(usual), more = model_compass_readings(noisy);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(more[i].field_uT[k] - exact[i].field_uT[k], 3 * (once[i].field_uT[k] - exact[i].field_uT[k]),
                  1e-12);
    }
    EXPECT_NE(once[i].field_uT[0], exact[i].field_uT[0]);
    EXPECT_NEAR(more[i].roll_rad - exact[i].roll_rad, 5 * (once[i].roll_rad - exact[i].roll_rad), 1e-14);
    EXPECT_NEAR(more[i].temperature_C - exact[i].temperature_C,
                2 * (once[i].temperature_C - exact[i].temperature_C), 1e-12);
  }
}

TEST(SimulatedInstruments, TheFluidFollowsWithTheLagOfTheModel) {
  for (const double lag_s : {0.1, 0.3, 0.9}) {
    Still motion;
    devices::CompassModel compass = devices::without_noise({}).compass;
    compass.tilt_lag_s = lag_s;
    Tcm2Sensor sensor(model_sensor_with(compass), motion, 1);
    sensor.power_on(kStart_ns);
    motion.state.euler_rad = {0.2, 0, 0};
    const double roll_rad = sensor.measure(kStart_ns + std::llround(lag_s * 1e9)).roll_rad;
    // The step is seen as a ramp of 10 ms.
    EXPECT_NEAR(roll_rad, 0.2 * (1 - std::exp(-(lag_s - 0.005) / lag_s)), 1e-4) << lag_s;
  }
}

TEST(SimulatedInstruments, AnInclinometerWithoutLagFollowsAtOnce) {
  Still motion;
  devices::CompassModel compass = devices::without_noise({}).compass;
  compass.tilt_lag_s = 0;
  Tcm2Sensor sensor(model_sensor_with(compass), motion, 1);
  sensor.power_on(kStart_ns);
  motion.state.euler_rad = {0.2, 0, 0};
  EXPECT_EQ(sensor.measure(kStart_ns + 20'000'000).roll_rad, 0.2);
}

std::vector<std::array<double, 8>> model_card_records(const devices::ImuModel& imu) {
  const Still motion;
  ImuCard::Options options;
  options.imu = imu;
  options.seed = 9;
  ImuCard card(options, motion);
  card.power_on(kStart_ns);
  std::vector<std::array<double, 8>> records;
  for (const auto& frame : run_to(card, kStart_ns + 2 * kSecond_ns)) {
    const auto record = protocols::imu_card::decode_record(frame.bytes);
    std::array<double, 8>& counts = records.emplace_back();
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = record->raw[i];
  }
  return records;
}

TEST(SimulatedInstruments, TheCardIsAsNoisyAsItsModelSays) {
  const devices::ImuModel usual;
  devices::ImuModel noisy = usual;
  noisy.gyro_noise_rad_s *= 4;
  noisy.turn_on_bias_rad_s *= 4;
  noisy.force_noise_m_s2 *= 2;
  noisy.depth_noise_m *= 3;
  const auto exact = model_card_records(devices::without_noise({}).imu), once = model_card_records(usual),
             more = model_card_records(noisy);
  ASSERT_EQ(once.size(), more.size());
  constexpr std::array<double, 8> kFactors{4, 4, 4, 4, 2, 2, 2, 3};
  for (std::size_t i = 0; i < once.size(); ++i) {
    for (std::size_t k = 0; k < 8; ++k) {
      // Each is rounded to a whole count.
      EXPECT_NEAR(more[i][k] - exact[i][k], kFactors[k] * (once[i][k] - exact[i][k]), 1 + kFactors[k]) << k;
    }
  }
}

TEST(SimulatedInstruments, TheCardHasTheZerosScalesAndLatencyOfItsPort) {
  struct Sinking : Motion {
    [[nodiscard]] State at(std::int64_t t_ns) const override {
      State state;
      state.position_m[2] = static_cast<double>(t_ns - kStart_ns) * 1e-9;
      return state;
    }
  } const motion;
  ImuCard::Options options;
  options.imu = devices::without_noise({}).imu;
  options.imu.timing = {.latency_s = 0.2, .latency_std_s = 0, .rate_Hz = 50, .baud = 57600};
  options.imu.channels.zero_mV[7] = 300;
  options.imu.channels.scale[7] = 100;
  ImuCard card(options, motion);
  card.power_on(kStart_ns);
  const auto frames = run_to(card, kStart_ns + 5 * kSecond_ns);
  EXPECT_EQ(frames.size(), 250U);
  for (const auto& frame : frames) {
    const double sent_s = static_cast<double>(frame.start_ns - kStart_ns) * 1e-9;
    const double depth_m = (protocols::imu_card::decode_record(frame.bytes)->raw[7] / 16.0 - 300) / 100;
    EXPECT_NEAR(sent_s - depth_m, 0.2, 1e-3);
  }
}

TEST(SimulatedInstruments, ARecordingHasTheRatesLatenciesAndPortsOfItsModel) {
  devices::InstrumentModel model;
  model.compass.timing.rate_Hz = 5;
  model.compass.timing.baud = 9600;
  model.imu.timing.rate_Hz = 50;
  model.imu.timing.latency_s = 0.04;
  model.imu.channels.scale[0] = 20;
  model.motor.timing.rate_Hz = 2;
  const auto ports = recording_ports(model);
  EXPECT_EQ(ports[0].rate_Hz, 5);
  EXPECT_EQ(ports[1].latency_s, 0.04);
  EXPECT_EQ(ports[0].baud, 9600);
  EXPECT_EQ(ports[1].imu_card, model.imu.channels);

  const Still motion;
  Recording::Options options;
  options.begin_ns = kStart_ns;
  options.instruments = model;
  Recording recording(options, motion);
  std::vector<LineRead> reads;
  recording.advance(kStart_ns + 20 * kSecond_ns, reads);
  std::array<int, kInstruments> bytes{};
  for (const LineRead& read : reads) {
    if (!read.sent) bytes[static_cast<std::size_t>(read.of)] += static_cast<int>(read.bytes.size());
  }
  constexpr int kCardFrame = static_cast<int>(protocols::imu_card::kFrameLength);
  EXPECT_NEAR(bytes[static_cast<std::size_t>(Instrument::imu)], 20 * 50 * kCardFrame, 2 * kCardFrame);
}

TEST(SimulatedInstruments, FixesComeWhereTheAntennaSeesTheSky) {
  struct AtDepth : Still {
    AtDepth() { state.position_m[2] = 1; }
  } const motion;
  const auto fixes = [&](double antenna_depth_m) {
    GpsReceiver::Options options;
    options.gps.antenna_depth_m = antenna_depth_m;
    GpsReceiver receiver(options, motion, 1);
    receiver.power_on(kStart_ns);
    int count = 0;
    for (int i = 1; i <= 30; ++i) count += receiver.measure(kStart_ns + i * kSecond_ns).fixed ? 1 : 0;
    return count;
  };
  EXPECT_EQ(fixes(0.35), 0);
  EXPECT_GE(fixes(1.5), 19);
}

TEST(SimulatedInstruments, TheMotorCardHasTheLagsOfItsVehicle) {
  const Still motion;
  MotorCard::Options options;
  options.motor = devices::without_noise({}).motor;
  options.fins.lag_s = 1;
  MotorCard card(options, motion);
  card.power_on(kStart_ns);
  card.on_bytes(kStart_ns, protocols::motor_card::encode_command({0, {20, 0, 0}}));
  const auto frames = run_to(card, kStart_ns + kSecond_ns + 6'000'000);
  const auto status = protocols::motor_card::decode_status(frames.back().bytes);
  EXPECT_NEAR(*status->fins_deg[0], 20 * (1 - std::exp(-0.995)), 0.11);
}

}  // namespace
}  // namespace navcal::sim::testing
