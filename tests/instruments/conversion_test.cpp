// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/tcm2.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

using namespace protocols;
constexpr double kDeg = std::numbers::pi / 180;

TEST(ImuCard, ChannelsBecomeBodyAxesInSi) {
  imu_card::Record record;
  record.sequence = 77;
  record.status = imu_card::leak_aft | imu_card::low_supply;
  const auto raw = [](double mV) { return static_cast<std::uint16_t>(mV * 16); };
  // roll 1, yaw A 2, pitch 3, yaw B -2 deg/s; 0.1, 0, -1 g; 2 m deep
  record.raw = {raw(2058), raw(2068), raw(2078), raw(2028), raw(2148), raw(2048), raw(1048), raw(625)};
  Collector collector(Protocol::imu_card);
  const auto bytes = imu_card::encode_record(record);
  collector.feed<imu_card::Parser>(Bytes(bytes));
  const auto samples = collector.all<ImuSample>();
  ASSERT_EQ(samples.size(), 1U);
  const ImuSample& imu = samples[0];
  EXPECT_DOUBLE_EQ(imu.rate_rad_s.value()[0], 1 * kDeg);
  EXPECT_DOUBLE_EQ(imu.rate_rad_s.value()[1], 3 * kDeg);
  EXPECT_DOUBLE_EQ(imu.rate_rad_s.value()[2], 2 * kDeg);
  EXPECT_DOUBLE_EQ(imu.yaw_rate_b_rad_s.value(), -2 * kDeg);
  EXPECT_NEAR(imu.specific_force_m_s2.value()[0], 0.981, 1e-12);
  EXPECT_NEAR(imu.specific_force_m_s2.value()[2], -9.81, 1e-12);
  EXPECT_DOUBLE_EQ(imu.depth_m.value(), 2);
  ASSERT_TRUE(imu.card);
  EXPECT_FALSE(imu.card->leak_forward);
  EXPECT_TRUE(imu.card->leak_aft);
  EXPECT_FALSE(imu.over_range);
  EXPECT_TRUE(imu.card->low_supply);
  EXPECT_EQ(collector.measurements[0].sequence, 77);
}

TEST(ImuCard, ZerosAndScalesAreTheUnitsOwn) {
  config::PortSettings settings;
  settings.protocol = Protocol::imu_card;
  settings.imu_card.zero_mV[1] = 2100;
  settings.imu_card.scale[1] = 12.5;
  Collector collector(settings);
  imu_card::Record record;
  record.raw[1] = 2350 * 16;
  const auto bytes = imu_card::encode_record(record);
  collector.feed<imu_card::Parser>(Bytes(bytes));
  EXPECT_DOUBLE_EQ(collector.all<ImuSample>()[0].rate_rad_s.value()[2], 20 * kDeg);
}

TEST(MotorCard, EmptyFieldsStayUnknown) {
  Collector collector(Protocol::motor_card);
  collector.feed<motor_card::Parser>(nmea("MCS,5,780,,1.5,-20.0,,0.61"));
  collector.feed<motor_card::Parser>(nmea("MCC,780,0.0,0.0,0.0"));  // what the host sends says nothing measured
  const auto samples = collector.all<MotorSample>();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].rpm_commanded, 780);
  EXPECT_FALSE(samples[0].rpm);
  EXPECT_DOUBLE_EQ(*samples[0].fins_rad[1], -20 * kDeg);
  EXPECT_FALSE(samples[0].fins_rad[2]);
  EXPECT_EQ(samples[0].current_A, 0.61);
  EXPECT_EQ(samples[0].sequence, 5);
}

TEST(Tcm2Compass, UnitsAreConfigurationNotInTheWord) {
  config::PortSettings settings;
  settings.protocol = Protocol::tcm2;
  settings.compass.heading_unit = config::AngleUnit::mils;
  settings.compass.temperature_unit = config::TemperatureUnit::F;
  Collector collector(settings);
  collector.feed<tcm2::Parser>(nmea("C1600.0P10.0R-2.5X55.11Y12.33Z-18.43T50.0"));
  const auto samples = collector.all<CompassSample>();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_DOUBLE_EQ(*samples[0].heading_rad, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(*samples[0].pitch_rad, 10 * kDeg);
  EXPECT_DOUBLE_EQ(*samples[0].temperature_C, 10);
  EXPECT_EQ((*samples[0].field_body_uT)[2], -18.43);
}

TEST(Tcm2Compass, TiltOutOfRangeVoidsHeadingAndTiltButNotTheField) {
  Collector collector(Protocol::tcm2);
  collector.feed<tcm2::Parser>(nmea("C10.0P70.0R1.0X1.00Y2.00Z3.00E002"));
  collector.feed<tcm2::Parser>(nmea("C10.0P70.0R1.0X1.00Y2.00Z3.00E001"));
  const auto samples = collector.all<CompassSample>();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_FALSE(samples[0].heading_rad || samples[0].pitch_rad || samples[0].roll_rad);
  EXPECT_TRUE(samples[0].field_body_uT);
  EXPECT_EQ(samples[0].error, 2U);
  EXPECT_TRUE(samples[1].heading_rad);
  EXPECT_EQ(samples[1].error, 1U);
}

TEST(Tcm2Compass, MagnetometerOutOfRangeVoidsHeadingAndFieldButNotTheTilt) {
  Collector collector(Protocol::tcm2);
  collector.feed<tcm2::Parser>(nmea("C10.0P7.0R1.0X1.00Y2.00Z3.00E004"));
  collector.feed<tcm2::Parser>(nmea("C10.0P7.0R1.0X1.00Y2.00Z3.00E007"));
  const auto samples = collector.all<CompassSample>();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_FALSE(samples[0].heading_rad || samples[0].field_body_uT);
  EXPECT_TRUE(samples[0].pitch_rad && samples[0].roll_rad);
  EXPECT_EQ(samples[0].error, 4U);
  EXPECT_FALSE(samples[1].heading_rad || samples[1].field_body_uT || samples[1].pitch_rad);
}

TEST(Tcm2Compass, FieldsThatAreOffAndNmeaOutput) {
  Collector collector(Protocol::tcm2);
  collector.feed<tcm2::Parser>("$C328.3T22.3*2E\r\n:\r\n$HCHDM,182.3,M*21\r\n");
  const auto samples = collector.all<CompassSample>();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_FALSE(samples[0].pitch_rad || samples[0].field_body_uT);
  EXPECT_DOUBLE_EQ(*samples[1].heading_rad, 182.3 * kDeg);
}

}  // namespace
}  // namespace navcal::instruments
