// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/channel_collector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace navcal::analysis {
namespace {

using instruments::Sample;

constexpr double kOneDegree = std::numbers::pi / 180;

class CollectedChannels : public ::testing::Test {
 protected:
  template <class Value>
  void take(double time_s, const Value& value) {
    Sample sample;
    sample.stamp.validity_ns = 5'000'000'000 + std::llround(time_s * 1e9);
    sample.stamp.validity_utc_ns = sample.stamp.validity_ns + 1000;
    sample.value = value;
    collector_.on_sample(sample);
  }
  /// The recorded channels by their names.
  std::map<std::string, RecordedChannel> channels() {
    config::Settings settings;
    settings.ports.emplace_back().name = "port";
    std::map<std::string, RecordedChannel> channels;
    for (auto& channel : collector_.take_channels(settings)) channels.emplace(channel.quantity, channel);
    return channels;
  }
  std::set<std::string> names() {
    std::set<std::string> names;
    for (const auto& [name, channel] : channels()) names.insert(name);
    return names;
  }

  ChannelCollector collector_;
};

TEST_F(CollectedChannels, WhatASampleLacksHasNoChannel) {
  take(0, instruments::CompassSample{});
  take(0, instruments::ImuSample{});
  take(0, instruments::GpsSample{});
  take(0, instruments::MotorSample{});
  take(0, instruments::DvlSample{});
  take(0, instruments::DepthSample{});
  take(0, instruments::PowerSample{});
  EXPECT_TRUE(names().empty());
}

TEST_F(CollectedChannels, EachMemberOfASampleHasItsChannel) {
  instruments::ImuSample imu;
  imu.rate_rad_s = {kOneDegree, 2 * kOneDegree, 3 * kOneDegree};
  imu.temperature_C = 20;
  take(0, imu);
  instruments::DvlSample dvl;
  dvl.bottom_velocity_m_s = {1, 2, 3};
  dvl.altitude_m = 9;
  take(1, dvl);
  instruments::DepthSample gauge;
  gauge.pressure_Pa = 101325;
  take(2, gauge);
  const auto found = channels();
  EXPECT_EQ(found.size(), 9U);
  EXPECT_NEAR(found.at("rate_z").series.values.at(0), 3, 1e-12);
  EXPECT_EQ(found.at("rate_z").unit, "deg/s");
  EXPECT_EQ(found.at("bottom_velocity_2").series.values.at(0), 2);
  EXPECT_EQ(found.at("bottom_distance").series.values.at(0), 9);
  EXPECT_EQ(found.at("pressure").series.time_s.at(0), 2);
  EXPECT_EQ(found.at("pressure").name(), "port.pressure");
}

TEST_F(CollectedChannels, AMissionSensorHasItsOwnNameAndUnit) {
  for (int i = 0; i < 3; ++i) {
    take(i, instruments::ScalarSample{
                instruments::Text<24>("oxygen"), instruments::Text<16>("umol/l"), 200.0 + i, {}});
    take(i, instruments::ScalarSample{instruments::Text<24>("salinity"), instruments::Text<16>("PSU"), 35, {}});
  }
  const auto found = channels();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found.at("oxygen").unit, "umol/l");
  EXPECT_EQ(found.at("oxygen").series.values, (std::vector<double>{200, 201, 202}));
}

TEST_F(CollectedChannels, NumbersThatAreNoneAreLeftOut) {
  instruments::AltimeterSample reading;
  double time_s = 0;
  for (const double value : {1.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, 2.0}) {
    reading.altitude_m = value;
    take(++time_s, reading);
  }
  EXPECT_EQ(channels().at("altitude").series.values, (std::vector<double>{1, 2}));
}

TEST_F(CollectedChannels, AHeadingThatPassesNorthIsContinuous) {
  instruments::CompassSample compass;
  for (const double heading_deg : {359.9, 0.1, 359.8, 0.0}) {
    compass.heading_rad = heading_deg * kOneDegree;
    take(1, compass);
  }
  const auto values = channels().at("heading").series.values;
  ASSERT_EQ(values.size(), 4U);
  for (const double value : values) EXPECT_NEAR(value, 360, 0.3);
}

TEST_F(CollectedChannels, TheFirstFixesAfterAPauseAreLeftOut) {
  instruments::GpsSample fix;
  fix.fix = instruments::Fix::fix_3d;
  fix.latitude_rad = 1;
  fix.longitude_rad = 0.5;
  fix.height_m = 12;
  for (int second = 0; second < 30; ++second) {
    take(second == 0 ? 0 : second + 0.01, fix);    // none on the bound of 10 s
    take(second + 0.5, instruments::GpsSample{});  // a message of another kind
  }
  for (int second = 60; second < 80; ++second) take(second == 60 ? 60 : second + 0.01, fix);
  const auto found = channels();
  const auto& series = found.at("north").series;
  EXPECT_EQ(series.values.size(), 30U);  // 10 to 29 s, 70 to 79 s
  EXPECT_NEAR(series.time_s.front(), 10.01, 1e-9);
  EXPECT_NEAR(series.values.front(), 0, 1e-9);
  EXPECT_EQ(found.at("height").series.values.size(), 30U);
}

TEST_F(CollectedChannels, TimesCountFromTheFirstSample) {
  take(0, instruments::AltimeterSample{});
  take(7.5, instruments::AltimeterSample{});
  EXPECT_NEAR(collector_.duration_s(), 7.5, 1e-9);
  EXPECT_EQ(collector_.begin_utc_ns(), 5'000'001'000);
}

}  // namespace
}  // namespace navcal::analysis
