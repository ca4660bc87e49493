// SPDX-License-Identifier: Apache-2.0
// Calibrators and navigation follow the instruments of the configuration.
#include <gtest/gtest.h>

#include <cmath>

#include "base/angles.h"
#include "config/load.h"
#include "devices/instrument_model.h"
#include "pipeline/calibration_options.h"
#include "pipeline/navigation_stage.h"

namespace navcal::pipeline {
namespace {

config::Settings instruments_of_two_ports() {
  config::Settings settings;
  settings.ports = {config::default_port("compass", protocols::Protocol::tcm2, 38400),
                    config::default_port("imu", protocols::Protocol::imu_card, 57600)};
  return settings;
}

calib::SuiteOptions options_of(const config::Settings& settings) {
  return suite_options(settings, calibrated_ports(settings));
}

TEST(InstrumentOptions, ReferenceInstrumentsGiveTheReferenceNoise) {
  const calib::SuiteOptions options = options_of(instruments_of_two_ports());
  EXPECT_EQ(options.heading_noise_rad, 0.5 * base::kRadiansPerDegree);
  EXPECT_EQ(options.field_noise_uT, 0.2);
  EXPECT_EQ(options.tilt_noise_rad, 0.0018);
  EXPECT_EQ(options.tilt_lag_s, 0.3);
  EXPECT_EQ(options.rate_noise_rad_sqrt_s, 0.1 * base::kRadiansPerDegree / std::sqrt(20.0));
  EXPECT_EQ(options.position_noise_m, 1);
  EXPECT_EQ(options.velocity_noise_m_s, 0.1);
}

TEST(InstrumentOptions, CalibratorsFollowTheInstruments) {
  config::Settings settings = instruments_of_two_ports();
  const calib::SuiteOptions usual = options_of(settings);
  settings.instruments.compass.field_noise_uT *= 3;
  settings.instruments.compass.tilt_lag_s = 0.1;
  settings.instruments.imu.gyro_noise_rad_s *= 2;
  settings.instruments.gps.position_noise_m *= 4;
  settings.instruments.gps.velocity_noise_m_s *= 5;
  settings.ports[1].rate_Hz = 80;
  const calib::SuiteOptions other = options_of(settings);
  EXPECT_NEAR(other.field_noise_uT / usual.field_noise_uT, 3, 1e-12);
  EXPECT_GT(other.heading_noise_rad, 2 * usual.heading_noise_rad);
  EXPECT_EQ(other.tilt_noise_rad, usual.tilt_noise_rad);
  EXPECT_EQ(other.tilt_lag_s, 0.1);
  EXPECT_NEAR(other.rate_noise_rad_sqrt_s / usual.rate_noise_rad_sqrt_s, 1, 1e-12)
      << "twice the noise, four times as often";
  EXPECT_NEAR(other.position_noise_m / usual.position_noise_m, 4, 1e-12);
  EXPECT_NEAR(other.velocity_noise_m_s / usual.velocity_noise_m_s, 5, 1e-12);
}

TEST(InstrumentOptions, ANoisierInclinometerIsReckonedWith) {
  config::Settings settings = instruments_of_two_ports();
  const calib::SuiteOptions usual = options_of(settings);
  settings.instruments.compass.tilt_noise_rad *= 10;
  EXPECT_GT(options_of(settings).tilt_noise_rad, 9 * usual.tilt_noise_rad);
  EXPECT_GT(options_of(settings).heading_noise_rad, 4 * usual.heading_noise_rad);
}

TEST(InstrumentOptions, NoiseThatTheConfigurationStatesForTheCalibratorsCounts) {
  config::Settings settings = instruments_of_two_ports();
  settings.instruments.compass.field_noise_uT *= 3;
  settings.calibration.heading_noise_rad = 0.02;
  settings.calibration.field_noise_uT = 0.7;
  EXPECT_EQ(options_of(settings).heading_noise_rad, 0.02);
  EXPECT_EQ(options_of(settings).field_noise_uT, 0.7);
}

TEST(InstrumentOptions, NavigationTakesTheLagOfTheInclinometer) {
  config::Settings settings = instruments_of_two_ports();
  EXPECT_EQ(navigation_options(settings).attitude.tilt_lag_s, 0.3);
  settings.instruments.compass.tilt_lag_s = 0.1;
  EXPECT_EQ(navigation_options(settings).attitude.tilt_lag_s, 0.1);
}

}  // namespace
}  // namespace navcal::pipeline
