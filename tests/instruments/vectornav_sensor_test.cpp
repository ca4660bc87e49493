// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "protocols/vectornav.h"
#include "protocols/vectornav_lines.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

namespace vn = protocols::vectornav;
using Verdict = Instrument::Verdict;

constexpr double kVnNaN = std::numeric_limits<double>::quiet_NaN();

vn::Reading whole_reading() {
  vn::Reading reading;
  reading.since_startup_ns = 5'000'000'000;
  reading.yaw_pitch_roll_deg = {-90, 10, -20};
  reading.rate_rad_s = {0.125, 0.25, -0.5};
  reading.acceleration_m_s2 = {0.5, 0.25, -9.75};
  reading.field_uT = {25, 0, 50};
  reading.temperature_C = 24;
  reading.pressure_Pa = 101'000;
  reading.yaw_pitch_roll_std_deg = {2, 0.5, 0.25};
  return reading;
}

struct VectorNavSamples : testing::Test {
  Collector collector{protocols::Protocol::vectornav};

  void take(const vn::Reading& reading) { collector.feed<vn::Parser>(vn::encode_binary(reading)); }
  void take(std::string_view body) {
    const std::string line = nmea(body);
    collector.feed<vn::Parser>(std::string_view(line));
  }
};

TEST_F(VectorNavSamples, OneMessageIsRatesAttitudeAndAirPressure) {
  take(whole_reading());
  ASSERT_EQ(collector.measurements.size(), 3U);
  const auto imu = collector.all<ImuSample>().at(0);
  EXPECT_EQ(imu.rate_rad_s, (Vector3{0.125, 0.25, -0.5}));
  EXPECT_EQ(imu.specific_force_m_s2, (Vector3{0.5, 0.25, -9.75}));
  EXPECT_EQ(imu.temperature_C, 24);
  EXPECT_FALSE(imu.depth_m || imu.card);
  const auto compass = collector.all<CompassSample>().at(0);
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(*compass.heading_rad, 1.5 * kPi, 1e-12) << "yaw of -90 degrees";
  EXPECT_FALSE(compass.heading_is_true);
  EXPECT_NEAR(*compass.pitch_rad, kPi / 18, 1e-12);
  EXPECT_NEAR(*compass.roll_rad, -kPi / 9, 1e-12);
  EXPECT_NEAR(*compass.heading_std_rad, kPi / 90, 1e-12);
  EXPECT_NEAR(*compass.tilt_std_rad, kPi / 360, 1e-12) << "the larger of the two";
  EXPECT_NEAR((*compass.field_body_uT)[2], 50, 1e-4);
  const auto pressure = collector.all<ScalarSample>().at(0);
  EXPECT_EQ(pressure.quantity.view(), "air pressure");
  EXPECT_EQ(pressure.unit.view(), "Pa");
  EXPECT_NEAR(pressure.value, 101'000, 0.01);
  // One tick of the sensor's clock, and its time with all three.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(collector.measurements[i].paces, i == 0);
    EXPECT_EQ(collector.measurements[i].device_time_ns, 5'000'000'000);
    EXPECT_FALSE(collector.measurements[i].stated_utc_ns);
  }
}

TEST_F(VectorNavSamples, CompensatedValuesArePreferred) {
  vn::Reading reading;
  reading.raw_acceleration_m_s2 = {1, 2, 3};
  reading.raw_rate_rad_s = {4, 5, 6};
  take(reading);
  EXPECT_EQ(collector.all<ImuSample>().at(0).rate_rad_s, (Vector3{4, 5, 6}));
  reading.rate_rad_s = {7, 8, 9};
  take(reading);
  EXPECT_EQ(collector.all<ImuSample>().at(1).rate_rad_s, (Vector3{7, 8, 9}));
  EXPECT_EQ(collector.all<ImuSample>().at(1).specific_force_m_s2, (Vector3{1, 2, 3}));
  EXPECT_TRUE(collector.all<CompassSample>().empty());
}

TEST_F(VectorNavSamples, LinesGiveTheSame) {
  take(
      "VNYMR,+100.949,-002.160,+000.310,-00.0478,+01.0670,+01.7383,-00.363,-00.165,-09.725,+00.001,-00.002,-00."
      "003");
  ASSERT_EQ(collector.measurements.size(), 2U);
  EXPECT_NEAR((*collector.all<ImuSample>().at(0).specific_force_m_s2)[2], -9.725, 1e-12);
  EXPECT_NEAR(*collector.all<CompassSample>().at(0).heading_rad, 100.949 / 180 * std::numbers::pi, 1e-12);
  EXPECT_NEAR((*collector.all<CompassSample>().at(0).field_body_uT)[1], 106.7, 1e-9);
  EXPECT_FALSE(collector.measurements[0].device_time_ns);
  take("VNYPR,-10.0,1.0,2.0");
  EXPECT_TRUE(collector.measurements.back().paces) << "the attitude alone";
  EXPECT_NEAR(*collector.all<CompassSample>().back().heading_rad, 350.0 / 180 * std::numbers::pi, 1e-12);
}

TEST_F(VectorNavSamples, AnswersAndPositionsAreNoMeasurements) {
  take("VNRRG,01,VN-100T-CR");
  take("VNERR,03");
  vn::Reading position;
  position.position = {37, -80, 100};
  position.velocity_ned_m_s = {1, 0, 0};
  take(position);
  vn::Reading pressure;
  pressure.pressure_Pa = 101'000;
  take(pressure);
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(4, Verdict::ignored));
  EXPECT_TRUE(collector.measurements.empty());
}

TEST_F(VectorNavSamples, ValuesThatCannotBe) {
  const auto damaged = [](auto change) {
    vn::Reading reading = whole_reading();
    change(reading);
    return reading;
  };
  take(damaged([](vn::Reading& r) { (*r.rate_rad_s)[1] = kVnNaN; }));
  take(damaged([](vn::Reading& r) { (*r.rate_rad_s)[0] = 41; }));
  take(damaged([](vn::Reading& r) { (*r.acceleration_m_s2)[2] = -401; }));
  take(damaged([](vn::Reading& r) { (*r.field_uT)[0] = 1001; }));
  take(damaged([](vn::Reading& r) { (*r.yaw_pitch_roll_deg)[0] = std::numeric_limits<double>::infinity(); }));
  take(damaged([](vn::Reading& r) { (*r.yaw_pitch_roll_deg)[1] = 91; }));
  take(damaged([](vn::Reading& r) { (*r.yaw_pitch_roll_deg)[2] = -181; }));
  take(damaged([](vn::Reading& r) { r.temperature_C = 131; }));
  take(damaged([](vn::Reading& r) { r.pressure_Pa = kVnNaN; }));
  take("VNGYR,1,2,99");
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(10, Verdict::out_of_range));
  EXPECT_TRUE(collector.measurements.empty());
  take(damaged([](vn::Reading& r) { r.yaw_pitch_roll_deg = {180, 90, -180}; }));
  EXPECT_EQ(collector.verdicts.back(), Verdict::used);
}

}  // namespace
}  // namespace navcal::instruments
