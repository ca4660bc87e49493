// SPDX-License-Identifier: Apache-2.0
// A recording with a MicroStrain sensor and nothing else: field and gyros, no second yaw gyro, no depth, no fixes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "analysis/calibrate_run.h"
#include "config/load.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "record/capture/capture_writer.h"
#include "sim/instruments/mip_unit.h"
#include "tests/sim/drive.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;

constexpr double kRun_s = 240;
constexpr std::int64_t kRunStep_ns = kSecond_ns / 100;
/// Iron in the vehicle.
constexpr sim::Vector3 kIron_uT{4, -3, 2};
constexpr double kGyroBias_rad_s = 0.01;

/// Turns to both sides at the surface, pitching and rolling a little; the sensor's place has iron and its yaw gyro
/// a bias.
struct Circles : sim::Motion {
  [[nodiscard]] static double yaw_rate_rad_s(double t_s) { return std::fmod(t_s, 60) < 40 ? 0.3 : -0.35; }
  [[nodiscard]] static double yaw_rad(double t_s) {
    const double rounds = std::floor(t_s / 60), rest_s = t_s - 60 * rounds;
    return rounds * (40 * 0.3 - 20 * 0.35) + 0.3 * std::min(rest_s, 40.0) - 0.35 * std::max(0.0, rest_s - 40);
  }
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    const double t_s = static_cast<double>(t_ns - kStart_ns) * 1e-9;
    sim::State state;
    const double roll = 0.04 * std::sin(0.7 * t_s), pitch = 0.03 * std::sin(0.5 * t_s);
    const double roll_rate = 0.028 * std::cos(0.7 * t_s), pitch_rate = 0.015 * std::cos(0.5 * t_s);
    const double yaw_rate = yaw_rate_rad_s(t_s);
    state.euler_rad = {roll, pitch, yaw_rad(t_s)};
    state.rate_rad_s = {roll_rate - std::sin(pitch) * yaw_rate,
                        std::cos(roll) * pitch_rate + std::sin(roll) * std::cos(pitch) * yaw_rate,
                        -std::sin(roll) * pitch_rate + std::cos(roll) * std::cos(pitch) * yaw_rate};
    constexpr double g = sim::kGravity_m_s2;
    state.specific_force_m_s2 = {g * std::sin(pitch), -g * std::sin(roll) * std::cos(pitch),
                                 -g * std::cos(roll) * std::cos(pitch)};
    return state;
  }
};

/// The packets of the emulated sensor, with iron and bias put into those of set 80.
std::vector<std::uint8_t> among_iron(const std::vector<std::uint8_t>& bytes) {
  protocols::mip::Packet packet = protocols::mip::decode(bytes);
  if (packet.set != protocols::mip::kSensorSet || !packet.field_uT || !packet.rate_rad_s) return bytes;
  for (std::size_t i = 0; i < 3; ++i) (*packet.field_uT)[i] += kIron_uT[i];
  (*packet.rate_rad_s)[2] += kGyroBias_rad_s;
  return protocols::mip::encode(packet);
}

config::Settings mip_settings() {
  config::Settings settings;
  auto port = config::default_port("sensor", protocols::Protocol::mip, 115200);
  port.rate_Hz = 20;
  settings.ports.push_back(port);
  return settings;
}

/// Text of a capture.
std::string mip_recording(const config::Settings& settings) {
  const Circles motion;
  sim::MipUnit::Options options;
  options.imu.turn_on_bias_rad_s = 0;
  sim::MipUnit unit(options, motion);
  const auto start_up = instruments::make_start_up(settings.ports[0]);
  protocols::mip::Parser parser;
  record::CaptureWriter writer(settings.ports);
  std::string capture;
  writer.begin(capture);
  unit.power_on(kStart_ns);
  start_up->begin(kStart_ns);
  const auto end_ns = kStart_ns + static_cast<std::int64_t>(kRun_s * 1e9);
  for (std::int64_t t_ns = kStart_ns; t_ns < end_ns; t_ns += kRunStep_ns) {
    std::vector<sim::Emission> emissions;
    unit.advance(t_ns, emissions);
    for (const auto& emission : emissions) {
      const auto bytes = among_iron(emission.bytes);
      const std::int64_t arrival_ns =
          emission.start_ns + static_cast<std::int64_t>(bytes.size()) * 10 * kSecond_ns / unit.baud();
      writer.bytes(capture, 0, record::Direction::received, arrival_ns, bytes);
      parser.feed(bytes, [&](const protocols::Frame& frame) { start_up->on_frame(frame, arrival_ns); });
    }
    while (const auto bytes = start_up->next(t_ns)) unit.on_bytes(t_ns, *bytes);
  }
  return capture;
}

TEST(CalibrateMip, ASensorAloneIsCalibrated) {
  const config::Settings settings = mip_settings();
  const navcal::test::TemporaryFolder folder;
  const std::string file = (folder / "mip.cap").string();
  std::ofstream(file) << mip_recording(settings);
  CalibrateRun run(settings, nullptr);
  run.play(file);
  const calib::Report report = run.finish();
  const auto* const second_gyro = report.find(calib::Calibrator::gyro_b);
  EXPECT_TRUE(second_gyro == nullptr || !second_gyro->judgement.accepted) << "there is none";
  for (const auto& calibrator : report.calibrators) {
    EXPECT_TRUE(calibrator.judgement.accepted || !calibrator.judgement.reason.empty())
        << calib::name_of(calibrator.calibrator);
  }
  const auto* const gyro = report.find(calib::Calibrator::gyro);
  ASSERT_NE(gyro, nullptr);
  EXPECT_TRUE(gyro->judgement.accepted) << gyro->judgement.reason;
  ASSERT_TRUE(report.estimates.gyro);
  EXPECT_NEAR(report.estimates.gyro->bias_rad_s, -kGyroBias_rad_s, 1e-3);
  EXPECT_NEAR(report.estimates.gyro->scale, 1, 0.01);
  const auto* const magnetometer = report.find(calib::Calibrator::magnetometer);
  ASSERT_NE(magnetometer, nullptr);
  EXPECT_TRUE(magnetometer->judgement.accepted) << magnetometer->judgement.reason;
  ASSERT_TRUE(report.estimates.magnetometer);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(report.estimates.magnetometer->offset_uT[static_cast<Eigen::Index>(i)], kIron_uT[i], 0.5) << i;
  }
  EXPECT_GT(report.heading.blocks, 0U);
  EXPECT_LT(report.heading.after_rad, report.heading.before_rad);
}

}  // namespace
}  // namespace navcal::analysis
