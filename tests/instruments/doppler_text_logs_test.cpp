// SPDX-License-Identifier: Apache-2.0
// Doppler logs that send text: PD6 and Water Linked, line by line.
#include <gtest/gtest.h>

#include "base/angles.h"
#include "protocols/pd6.h"
#include "protocols/water_linked.h"
#include "tests/instruments/collector.h"
#include "tests/instruments/velocity.h"

namespace navcal::instruments {
namespace {

namespace water_linked = protocols::water_linked;
using Verdict = Instrument::Verdict;

TEST(Pd6Log, OnePingIsOneSample) {
  Collector collector(protocols::Protocol::pd6);
  collector.feed<protocols::pd6::Parser>(
      ":SA, -2.00, +4.00,090.00\r\n:TS,26112423595999,35.0,+15.0,0002.5,1500.1,000\r\n"
      ":WI,+00010,+00950,+00003,-00001,A\r\n:WS,+00099,+00099,+00099,A\r\n:WE,-32768,-32768,-32768,V\r\n"
      ":WD,+00000001.00,-00000002.50,+00000000.00,0012.00,000.20\r\n"
      ":BI,+00012,+00980,+00004,+00002,A\r\n:BS,+00099,+00099,+00099,A\r\n:BE,+00980,-00012,+00004,A\r\n"
      ":BD,+00000000.00,-00000001.50,+00000000.00,0020.40,000.25\r\n");
  ASSERT_EQ(collector.all<DvlSample>().size(), 1U);
  const DvlSample sample = collector.all<DvlSample>().front();
  EXPECT_EQ(sample.frame, VelocityFrame::body);
  expect_velocity(sample.bottom_velocity_m_s, {0.98, 0.012, -0.004});
  expect_velocity(sample.water_velocity_m_s, {0.95, 0.01, -0.003});
  EXPECT_EQ(sample.altitude_m, 20.4);
  EXPECT_EQ(sample.sound_speed_m_s, 1500.1);
  EXPECT_EQ(sample.temperature_C, 15.0);
  ASSERT_EQ(collector.all<CompassSample>().size(), 1U);
  EXPECT_NEAR(collector.all<CompassSample>().front().heading_rad.value(), base::kTurn_rad / 4, 1e-9);
  EXPECT_NEAR(collector.all<CompassSample>().front().pitch_rad.value(), -2 * base::kRadiansPerDegree, 1e-9);
  EXPECT_TRUE(collector.all<DepthSample>().empty()) << "the depth of TS may be a setting";
}

TEST(Pd6Log, EarthAxesWhereThereAreNoOthers) {
  Collector collector(protocols::Protocol::pd6);
  collector.feed<protocols::pd6::Parser>(
      ":SA,+00.00,+00.00,000.00\r\n:BI,-32768,-32768,-32768,-32768,V\r\n:BS,+00099,+00099,+00099,A\r\n"
      ":BE,+00300,-00200,+00100,A\r\n:BD,+00000000.00,+00000000.00,+00000000.00,0000.00,000.25\r\n");
  const DvlSample sample = collector.all<DvlSample>().at(0);
  EXPECT_EQ(sample.frame, VelocityFrame::earth);
  expect_velocity(sample.bottom_velocity_m_s, {-0.2, 0.3, -0.1});
  EXPECT_FALSE(sample.altitude_m) << "no range";
}

TEST(Pd6Log, APingWithoutItsEndIsForgotten) {
  Collector collector(protocols::Protocol::pd6);
  collector.feed<protocols::pd6::Parser>(
      ":SA,+00.00,+00.00,000.00\r\n:BI,+00012,+00980,+00004,+00002,A\r\n"
      ":SA,+00.00,+00.00,000.00\r\n:BI,+00000,-00500,+00000,+00002,V\r\n"
      ":BD,+00000000.00,+00000000.00,+00000000.00,0010.00,001.25\r\n");
  ASSERT_EQ(collector.all<DvlSample>().size(), 1U);
  EXPECT_FALSE(collector.all<DvlSample>().front().bottom_velocity_m_s)
      << "status V, and no rest of the ping before";
}

TEST(Pd6Log, WhatCannotBeIsCounted) {
  Collector collector(protocols::Protocol::pd6);
  collector.feed<protocols::pd6::Parser>(
      ":SA,+00.00,+00.00,400.00\r\n:SA,1,2\r\n:BI,1,2,3,A\r\n:BD,1\r\n:TS,1,2\r\n");
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(5, Verdict::out_of_range));
  EXPECT_TRUE(collector.measurements.empty());
}

TEST(WaterLinkedLog, AVelocityWithItsErrorAndItsAge) {
  water_linked::Velocity velocity;
  velocity.velocity_m_s = {0.98, -0.012, 0.004};
  velocity.valid = true;
  velocity.altitude_m = 17.32;
  velocity.figure_of_merit_m_s = 0.5;
  velocity.covariance_m2_s2 = std::array<double, 9>{1e-4, 0, 0, 0, 4e-4, 0, 0, 0, 1e-6};
  velocity.valid_at_us = 1'700'000'000'100'000;
  velocity.transmitted_at_us = 1'700'000'000'195'000;
  Collector collector(protocols::Protocol::water_linked);
  collector.feed<water_linked::Parser>(water_linked::encode(velocity));
  ASSERT_EQ(collector.measurements.size(), 1U);
  const DvlSample sample = collector.all<DvlSample>().front();
  EXPECT_EQ(sample.frame, VelocityFrame::body);
  expect_velocity(sample.bottom_velocity_m_s, {0.98, -0.012, 0.004});
  EXPECT_NEAR(sample.bottom_velocity_std_m_s.value(), 0.02, 1e-9) << "of the worst axis";
  EXPECT_NEAR(sample.altitude_m.value(), 17.32, 1e-9);
  EXPECT_EQ(collector.measurements.front().age_ns, 95'000'000);
  EXPECT_FALSE(collector.measurements.front().stated_utc_ns) << "its clock need not be UTC";

  // A clock that was set between the two stamps, and lines of the older protocol.
  velocity.transmitted_at_us = 1'600'000'000'000'000;
  collector.feed<water_linked::Parser>(water_linked::encode(velocity));
  EXPECT_FALSE(collector.measurements.at(1).age_ns);
  collector.feed<water_linked::Parser>(water_linked::encode_line("wrx,112.83,0.007,0.017,0.006,0.500,0.93,y,0"));
  EXPECT_FALSE(collector.measurements.at(2).age_ns);
  EXPECT_NEAR(collector.all<DvlSample>().at(2).bottom_velocity_std_m_s.value(), 0.5, 1e-9) << "figure of merit";
  collector.feed<water_linked::Parser>(water_linked::encode_line("wrx,112.83,0.007,0.017,0.006,0.000,0.93,y,0"));
  EXPECT_FALSE(collector.all<DvlSample>().at(3).bottom_velocity_std_m_s);
}

TEST(WaterLinkedLog, WithoutLockNothingIsTaken) {
  Collector collector(protocols::Protocol::water_linked);
  collector.feed<water_linked::Parser>("wrx,1075.51,0.000,0.000,0.000,2.707,-1.00,n,1*04\n");
  ASSERT_EQ(collector.all<DvlSample>().size(), 1U);
  EXPECT_FALSE(collector.all<DvlSample>().front().bottom_velocity_m_s);
  EXPECT_FALSE(collector.all<DvlSample>().front().altitude_m);
  EXPECT_EQ(collector.verdicts.front(), Verdict::used);
}

TEST(WaterLinkedLog, ItsOwnTiltMakesTheAltitudeVertical) {
  water_linked::Velocity velocity;
  velocity.valid = true;
  velocity.altitude_m = 10;
  Collector collector(protocols::Protocol::water_linked);
  const auto velocity_line = water_linked::encode(velocity);
  collector.feed<water_linked::Parser>(velocity_line);
  collector.feed<water_linked::Parser>(water_linked::encode_line("wrp,9.500,1.50,-2.00,0.25,0.50,60.0,0.0,0.0,0"));
  for (int i = 0; i < 20; ++i) collector.feed<water_linked::Parser>(velocity_line);
  const auto samples = collector.all<DvlSample>();
  EXPECT_NEAR(samples.at(0).altitude_m.value(), 10, 1e-9);
  EXPECT_NEAR(samples.at(1).altitude_m.value(), 5, 1e-9);
  EXPECT_NEAR(samples.at(20).altitude_m.value(), 10, 1e-9) << "wrp no longer comes";
  const auto places = collector.all<ScalarSample>();
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[1].quantity.view(), "local y");
  EXPECT_EQ(places[1].unit.view(), "m");
  EXPECT_NEAR(places[1].value, -2, 1e-9);
  EXPECT_NEAR(places[1].value_std.value(), 0.5, 1e-9);
}

TEST(WaterLinkedLog, TheNetworkPortGivesTheSame) {
  Collector collector(protocols::Protocol::water_linked);
  collector.feed<water_linked::Parser>(
      R"({"ts":9.5,"x":0.5,"y":0,"z":0,"std":0.1,"roll":60,"pitch":0,"yaw":0,"type":"position_local","status":0})"
      "\r\n"
      R"({"time":125,"vx":0.123,"vy":-0.045,"vz":0.01,"fom":0.0012,"covariance":[[4e-4,0,0],[0,1e-4,0],[0,0,1e-4]],)"
      R"("altitude":3.2,"transducers":[{"id":0}],"velocity_valid":true,"status":0,"type":"velocity",)"
      R"("time_of_validity":1790000000000000,"time_of_transmission":1790000000120000})"
      "\r\n"
      R"({"response_to":"calibrate_gyro","success":true,"error_message":"","result":null,"type":"response"})"
      "\r\n"
      R"({"time":125,"vx":0,"velocity_valid":true,"type":"velocity"})"
      "\r\n");
  EXPECT_EQ(collector.verdicts,
            (std::vector{Verdict::used, Verdict::used, Verdict::ignored, Verdict::out_of_range}));
  EXPECT_EQ(collector.all<ScalarSample>().size(), 3U);
  const auto sample = collector.all<DvlSample>().at(0);
  expect_velocity(sample.bottom_velocity_m_s, {0.123, -0.045, 0.010});
  EXPECT_NEAR(sample.bottom_velocity_std_m_s.value(), 0.02, 1e-9);
  EXPECT_NEAR(sample.altitude_m.value(), 1.6, 1e-9) << "with its own tilt";
  EXPECT_EQ(collector.measurements.back().age_ns, 120'000'000);
}

TEST(WaterLinkedLog, OtherLinesAreIgnoredAndImpossibleOnesCounted) {
  Collector collector(protocols::Protocol::water_linked);
  collector.feed<water_linked::Parser>("wrp,49056.809,0.41,0.15,1.23,0.4,53.9,13.0,19.3,0*de\n");
  collector.feed<water_linked::Parser>("wru,0,0.070,1.10,-40,-95*9c\n");
  EXPECT_EQ(collector.verdicts, (std::vector{Verdict::used, Verdict::ignored}));
  collector.feed<water_linked::Parser>(water_linked::encode_line("wrz,1,2"));
  EXPECT_EQ(collector.verdicts.back(), Verdict::out_of_range);
  EXPECT_TRUE(collector.all<DvlSample>().empty());
}

}  // namespace
}  // namespace navcal::instruments
