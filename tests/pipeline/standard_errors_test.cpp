// SPDX-License-Identifier: Apache-2.0
#include "pipeline/standard_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace navcal::pipeline {
namespace {

template <class Kind>
Kind completed(const Kind& value, const config::Settings& settings = {}) {
  instruments::Sample sample;
  sample.value = value;
  StandardErrors(settings).complete(sample);
  return std::get<Kind>(sample.value);
}

TEST(StandardErrors, WhatWasNotMeasuredHasNone) {
  const auto compass = completed(instruments::CompassSample{});
  EXPECT_FALSE(compass.heading_std_rad || compass.tilt_std_rad || compass.field_std_uT);
  const auto imu = completed(instruments::ImuSample{});
  EXPECT_FALSE(imu.rate_std_rad_s || imu.specific_force_std_m_s2 || imu.depth_std_m);
  const auto gps = completed(instruments::GpsSample{});
  EXPECT_FALSE(gps.position_std_m || gps.velocity_std_m_s || gps.height_std_m);
  const auto motor = completed(instruments::MotorSample{});
  EXPECT_FALSE(motor.fins_std_rad || motor.current_std_A);
}

TEST(StandardErrors, TheDevicesOwnStatementStands) {
  instruments::GpsSample gps;
  gps.latitude_rad = gps.longitude_rad = 0.5;
  gps.speed_m_s = 1;
  gps.position_std_m = 0.01;
  gps.velocity_std_m_s = 0.02;
  EXPECT_EQ(completed(gps).position_std_m, 0.01);
  EXPECT_EQ(completed(gps).velocity_std_m_s, 0.02);
  instruments::ImuSample imu;
  imu.rate_rad_s = instruments::Vector3{};
  imu.rate_std_rad_s = 1e-6;
  EXPECT_EQ(completed(imu).rate_std_rad_s, 1e-6);
}

TEST(StandardErrors, TheConfigurationSaysTheRest) {
  config::Settings settings;
  settings.instruments.compass.field_noise_uT = 0.3;
  settings.instruments.imu.gyro_noise_rad_s = 0.004;
  settings.instruments.imu.depth_noise_m = 0.05;
  settings.navigation.altitude_noise_m = 0.4;
  instruments::CompassSample compass;
  compass.field_body_uT = instruments::Vector3{20, 0, 40};
  EXPECT_EQ(completed(compass, settings).field_std_uT, 0.3);
  EXPECT_FALSE(completed(compass, settings).heading_std_rad) << "a bare magnetometer states no heading";
  instruments::ImuSample imu;
  imu.rate_rad_s = instruments::Vector3{};
  EXPECT_EQ(completed(imu, settings).rate_std_rad_s, 0.004);
  EXPECT_FALSE(completed(imu, settings).depth_std_m);
  imu.depth_m = 3;
  EXPECT_EQ(completed(imu, settings).depth_std_m, 0.05);
  EXPECT_EQ(completed(instruments::AltimeterSample{2, {}}, settings).altitude_std_m, 0.4);
}

TEST(StandardErrors, APoorSkyMakesAPositionWorseAndAGoodOneNotBetter) {
  config::Settings settings;
  settings.instruments.gps.position_noise_m = 2;
  instruments::GpsSample gps;
  gps.latitude_rad = gps.longitude_rad = 0.5;
  EXPECT_EQ(completed(gps, settings).position_std_m, 2) << "no statement: a good sky";
  gps.dop = 1;
  EXPECT_EQ(completed(gps, settings).position_std_m, 2);
  gps.dop = 6;
  EXPECT_EQ(completed(gps, settings).position_std_m, 6);
}

}  // namespace
}  // namespace navcal::pipeline
