// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/noise_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/load.h"
#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

const NoiseChannel* row(std::string_view name) {
  for (const auto& channel : noise_channels()) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

RecordedChannel recorded(std::string port, std::string_view name, std::vector<double> values) {
  RecordedChannel channel{std::move(port),
                          std::string(name),
                          std::string(row(name)->unit),
                          row(name),
                          noise_test::series_of(std::move(values), 0.05),
                          {}};
  channel.noise = channel_noise(channel.series, {{0, 1e9}});
  return channel;
}

config::Settings settings_with(std::vector<std::string> ports) {
  config::Settings settings;
  for (auto& name : ports)
    settings.ports.push_back(config::default_port(std::move(name), protocols::Protocol::imu_card, 57600));
  return settings;
}

NoiseReport report_of(std::vector<RecordedChannel> channels) {
  NoiseReport report;
  report.file = "bench\n= 1.cap";
  report.quiet = {{0, 100}};
  report.channels = std::move(channels);
  return report;
}

TEST(NoiseSettings, TheFileIsReadAndHoldsWhatWasFound) {
  noise_test::MadeNoise noise(1);
  const auto report = report_of({recorded("imu", "rate_x", noise.white(20000, 0.04)),
                                 recorded("imu", "rate_z", noise.white(20000, 0.06)),
                                 recorded("imu", "depth", std::vector<double>(500, 1.0))});
  auto settings = settings_with({"imu"});
  settings.instruments.gps.position_noise_m = 3.5;
  const std::string toml = noise_configuration(report, settings);
  const auto read = config::parse(toml, "written");
  EXPECT_NEAR(read.instruments.imu.gyro_noise_rad_s,
              std::sqrt((0.04 * 0.04 + 0.06 * 0.06) / 2) * std::numbers::pi / 180, 2e-5);
  EXPECT_EQ(read.instruments.gps.position_noise_m, 3.5);
  EXPECT_EQ(read.instruments.imu.depth_noise_m, settings.instruments.imu.depth_noise_m);
  ASSERT_EQ(read.ports.size(), 1U);
  EXPECT_EQ(read.ports[0].path, "/dev/navcal/imu");
  EXPECT_NE(toml.find("imu.depth: constant: noise below the resolution\n"), std::string::npos) << toml;
  EXPECT_NE(toml.find("# Not determined: the recording has no such readings.\ngps_position_noise_m = 3.5\n"),
            std::string::npos)
      << toml;
}

TEST(NoiseSettings, EveryKeyOfATableRowIsOneOfTheConfiguration) {
  noise_test::MadeNoise noise(2);
  std::vector<RecordedChannel> channels;
  for (const auto& channel : noise_channels()) {
    if (!channel.setting.empty()) channels.push_back(recorded("imu", channel.name, noise.white(5000, 0.5)));
  }
  const auto report = report_of(std::move(channels));
  const auto found = found_settings(report, settings_with({"imu"}));
  EXPECT_EQ(found.size(), 10U);
  const auto read = config::parse(noise_configuration(report, settings_with({"imu"})), "written");
  const auto& instruments = read.instruments;
  EXPECT_NEAR(instruments.compass.field_noise_uT, 0.5, 0.02);
  EXPECT_NEAR(instruments.compass.tilt_noise_rad, 0.5 * std::numbers::pi / 180, 0.0004);
  EXPECT_NEAR(instruments.compass.temperature_noise_C, 0.5, 0.03);
  EXPECT_NEAR(instruments.imu.force_noise_m_s2, 0.5, 0.02);
  EXPECT_NEAR(instruments.imu.depth_noise_m, 0.5, 0.03);
  EXPECT_NEAR(instruments.gps.position_noise_m, 0.5, 0.03);
  EXPECT_NEAR(instruments.gps.velocity_noise_m_s, 0.5, 0.03);
  EXPECT_NEAR(instruments.motor.fin_noise_rad, 0.5 * std::numbers::pi / 180, 0.0004);
  EXPECT_NEAR(instruments.motor.current_noise_A, 0.5, 0.03);
}

TEST(NoiseSettings, ThePortOfTheRoleCounts) {
  noise_test::MadeNoise noise(3);
  const auto report = report_of(
      {recorded("a", "rate_z", noise.white(5000, 0.1)), recorded("b", "rate_z", noise.white(5000, 0.3))});
  auto settings = settings_with({"a", "b"});
  EXPECT_NEAR(found_settings(report, settings).at(3).value.value_or(0), 0.1, 0.01);
  settings.roles.port_names.at(static_cast<std::size_t>(config::Role::rates)) = "b";
  EXPECT_EQ(found_settings(report, settings).at(3).key, "imu_gyro_noise_deg_s");
  EXPECT_NEAR(found_settings(report, settings).at(3).value.value_or(0), 0.3, 0.01);
}

TEST(NoiseSettings, WhatIsOutsideTheRangeOfAKeyIsLeft) {
  const auto report = report_of({recorded("imu", "rate_z", noise_test::MadeNoise(4).white(5000, 50)),
                                 recorded("imu", "depth", noise_test::MadeNoise(4).white(5000, 0.5))});
  const std::string toml = noise_configuration(report, settings_with({"imu"}));
  EXPECT_NE(toml.find("outside the range"), std::string::npos);
  EXPECT_EQ(config::parse(toml, "written").instruments.imu.gyro_noise_rad_s,
            config::Settings{}.instruments.imu.gyro_noise_rad_s);
}

TEST(NoiseSettings, NothingFoundIsNoFile) {
  EXPECT_EQ(noise_configuration(report_of({}), settings_with({"imu"})), "");
  EXPECT_EQ(noise_configuration(report_of({recorded("imu", "rate_z", {1, 2, 3})}), settings_with({"imu"})), "");
}

TEST(NoiseChannels, NamesAreUniqueAndEachSettingHasARole) {
  for (const auto& channel : noise_channels()) {
    EXPECT_EQ(std::count_if(noise_channels().begin(), noise_channels().end(),
                            [&](const auto& other) { return other.name == channel.name; }),
              1)
        << channel.name;
    EXPECT_EQ(channel.setting.empty(), !channel.role.has_value()) << channel.name;
  }
}

}  // namespace
}  // namespace navcal::analysis
