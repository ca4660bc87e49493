// SPDX-License-Identifier: Apache-2.0
// Lines of `navcal replay --json` may be injected again, and give the same samples.

#include <gtest/gtest.h>

#include <cmath>

#include "protocols/samples_line.h"
#include "record/json/message_json.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

using Verdict = Instrument::Verdict;

Collector collect(std::string_view lines) {
  Collector collector(protocols::Protocol::samples);
  collector.feed<protocols::samples_line::Parser>(lines);
  return collector;
}

std::string json_of(const Value& value, const Stamp& stamp) {
  Sample sample;
  sample.value = value;
  sample.stamp = stamp;
  std::string json;
  record::append_json(json, sample, "device");
  return json + "\n";
}

std::vector<Value> samples_of_each_kind() {
  CompassSample compass;
  compass.heading_rad = 1.5;
  compass.heading_is_true = true;
  compass.pitch_rad = -0.25;
  compass.field_body_uT = Vector3{20.125, -1e-3, 43.5};
  compass.error = 0x2A0;
  compass.heading_std_rad = 0.01;
  ImuSample imu;
  imu.rate_rad_s = Vector3{0.1, -0.2, 0.30000000000000004};
  imu.specific_force_m_s2 = Vector3{0, 0.5, -9.81};
  imu.depth_m = 3.5;
  imu.card = CardState{200, true, false, true};
  imu.over_range = true;
  GpsSample gps;
  gps.time_utc_ns = 1'700'000'000'123'456'789;
  gps.fix = Fix::fix_3d;
  gps.latitude_rad = 0.5;
  gps.longitude_rad = -1.5;
  gps.height_m = 12.5;
  gps.speed_m_s = 1.25;
  gps.course_rad = 6;
  gps.tracked = 7;
  gps.position_std_m = 2.5;
  MotorSample motor;
  motor.rpm = 780;
  motor.fins_rad = {0.1, std::nullopt, -0.2};
  motor.sequence = 9;
  DvlSample dvl;
  dvl.frame = VelocityFrame::earth;
  dvl.bottom_velocity_m_s = Vector3{1, -0.5, 0.01};
  dvl.altitude_m = 12;
  DepthSample depth;
  depth.pressure_Pa = 151325.5;
  depth.temperature_C = 8.25;
  ScalarSample oxygen;
  oxygen.quantity = decltype(oxygen.quantity)("oxygen");
  oxygen.unit = decltype(oxygen.unit)("\u00b5mol/l");
  oxygen.value = 250.5;
  return {compass, imu, gps, motor, AltimeterSample{7.5, 0.1}, PowerSample{14.5, -2}, dvl, depth, oxygen};
}

TEST(InjectedSamples, ALineOfAReplayGivesTheSameSample) {
  const Stamp stamp{0, 0, 2'000'001, 1'700'000'000'200'000'000, 1'700'000'000'123'456'789};
  for (const Value& value : samples_of_each_kind()) {
    const std::string line = json_of(value, stamp);
    const auto found = collect(line);
    ASSERT_EQ(found.measurements.size(), 1U) << line;
    const Measurement& measurement = found.measurements[0];
    EXPECT_EQ(json_of(measurement.value, stamp), line);
    ASSERT_TRUE(measurement.by_sender);
    EXPECT_EQ(measurement.by_sender->utc_ns, stamp.validity_utc_ns);
    EXPECT_EQ(measurement.by_sender->std_ns, stamp.std_ns);
    EXPECT_FALSE(measurement.paces);
    EXPECT_FALSE(measurement.utc_is_known) << "it defines no clock";
  }
}

TEST(InjectedSamples, AMinimumOfMembersSuffices) {
  const auto found = collect(
      "{\"class\":\"GPS\",\"lat\":47.5,\"lon\":-122}\n"
      "{\"class\":\"IMU\",\"rate_rad_s\":[0,0,1]}\n"
      "{\"class\":\"COMPASS\",\"heading_rad\":-1}\n"
      "{\"class\":\"DVL\"}\n");
  ASSERT_EQ(found.measurements.size(), 4U);
  const auto gps = found.all<GpsSample>().at(0);
  EXPECT_EQ(gps.fix, Fix::fix_2d) << "what is sent without a word on its quality counts";
  EXPECT_DOUBLE_EQ(gps.latitude_rad.value(), 47.5 * 3.14159265358979323846 / 180);
  EXPECT_FALSE(found.all<ImuSample>().at(0).specific_force_m_s2);
  EXPECT_NEAR(found.all<CompassSample>().at(0).heading_rad.value(), 2 * 3.14159265358979323846 - 1, 1e-12);
  EXPECT_FALSE(found.all<DvlSample>().at(0).bottom_velocity_m_s);
  EXPECT_FALSE(found.measurements[0].by_sender->utc_ns);
}

TEST(InjectedSamples, WhatCannotBeIsCountedAndGivesNoSample) {
  for (const char* const line :
       {"{\"class\":\"SONAR\",\"range_m\":3}", "{\"depth_m\":3}", "{\"class\":\"DEPTH\",\"depth_m\":\"3\"}",
        "{\"class\":\"DEPTH\",\"depth_m\":20000}", "{\"class\":\"GPS\",\"lat\":91,\"lon\":0}",
        "{\"class\":\"GPS\",\"lat\":9}", "{\"class\":\"GPS\",\"fix\":\"4d\"}",
        "{\"class\":\"IMU\",\"rate_rad_s\":[1,2]}", "{\"class\":\"IMU\",\"rate_rad_s\":[1,2,null]}",
        "{\"class\":\"DVL\",\"frame\":\"beam\"}", "{\"class\":\"SENSOR\",\"value\":3}",
        "{\"class\":\"SENSOR\",\"quantity\":\"\",\"value\":3}", "{\"class\":\"DEPTH\",\"depth_m\":3,\"time\":-1}",
        "{\"class\":\"DEPTH\",\"depth_m\":3,\"time\":\"now\"}",
        "{\"class\":\"DEPTH\",\"depth_m\":3,\"time_std\":-1}", "{\"class\":\"COMPASS\",\"error\":\"xyz\"}",
        "{\"class\":\"DEPTH\",\"depth_m\":1e999}", "{\"class\":\"POWER\",\"voltage_V\":nan}"}) {
    const auto found = collect(std::string(line) + "\n");
    ASSERT_EQ(found.verdicts.size(), 1U) << line;
    EXPECT_EQ(found.verdicts[0], Verdict::out_of_range) << line;
    EXPECT_TRUE(found.measurements.empty()) << line;
  }
}

TEST(InjectedSamples, WhatIsNoMeasurementIsIgnored) {
  for (const char* const line :
       {"{\"class\":\"NAV\",\"lat\":1}", "{\"class\":\"EVENT\"}", "{\"class\":\"SKY\"}",
        "{\"class\":\"DEPTH\",\"salinity\":35}", "{\"class\":\"POWER\",\"voltage_V\":null}"}) {
    const auto found = collect(std::string(line) + "\n");
    ASSERT_EQ(found.verdicts.size(), 1U) << line;
    EXPECT_EQ(found.verdicts[0], Verdict::ignored) << line;
    EXPECT_TRUE(found.measurements.empty()) << line;
  }
}

}  // namespace
}  // namespace navcal::instruments
