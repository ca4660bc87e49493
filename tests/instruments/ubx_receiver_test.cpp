// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx_receiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "config/load.h"
#include "protocols/ubx_navigation.h"
#include "protocols/wire_fields.h"
#include "tests/instruments/collector.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/ubx_samples.h"

namespace navcal::instruments {
namespace {

namespace ubx = protocols::ubx;
using Verdict = Instrument::Verdict;

/// A good fix of 2026-11-24 12:00:00 UTC, 0.4 ms early.
ubx::NavPvt good_fix() {
  ubx::NavPvt pvt;
  pvt.date = {2026, 11, 24};
  pvt.hour = 12;
  pvt.nanosecond = -400'000;
  pvt.date_valid = pvt.time_valid = pvt.fully_resolved = true;
  pvt.time_accuracy_s = 25e-9;
  pvt.fix_type = 3;
  pvt.fix_ok = true;
  pvt.satellites = 11;
  pvt.latitude_deg = 37.25;
  pvt.longitude_deg = -80.5;
  pvt.height_m = 620;
  pvt.height_msl_m = 653;
  pvt.horizontal_accuracy_m = 2;
  pvt.vertical_accuracy_m = 3;
  pvt.velocity_ned_m_s = {3, 4, -0.5};
  pvt.ground_speed_m_s = 5;
  pvt.heading_of_motion_deg = 53.13;
  pvt.speed_accuracy_m_s = 0.25;
  pvt.pdop = 1.5;
  return pvt;
}

constexpr std::int64_t kNoon_ns = 1'795'521'600'000'000'000;  // 2026-11-24 12:00:00 UTC, by date(1)

struct UbxSamples : testing::Test {
  config::PortSettings settings = config::default_port("gps", protocols::Protocol::ubx, 38400);
  Collector collector{settings};

  void take(const std::vector<std::uint8_t>& bytes) { collector.feed<ubx::PortParser>(bytes); }
  void take(const std::string& sentence) { collector.feed<ubx::PortParser>(std::string_view(sentence)); }
  [[nodiscard]] const Measurement& newest() const { return collector.measurements.back(); }
  [[nodiscard]] GpsSample gps() const { return std::get<GpsSample>(newest().value); }
};

TEST_F(UbxSamples, AFixInSiUnitsWithItsErrors) {
  take(ubx::encode_nav_pvt(good_fix()));
  ASSERT_EQ(collector.measurements.size(), 1U);
  const GpsSample sample = gps();
  EXPECT_EQ(sample.time_utc_ns, kNoon_ns - 400'000);
  EXPECT_EQ(newest().stated_utc_ns, kNoon_ns - 400'000);
  EXPECT_TRUE(newest().utc_is_known);
  EXPECT_EQ(sample.fix, Fix::fix_3d);
  EXPECT_NEAR(*sample.latitude_rad, 37.25 / 180 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(*sample.longitude_rad, -80.5 / 180 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(*sample.height_m, 620, 1e-9);
  EXPECT_NEAR(*sample.height_msl_m, 653, 1e-9);
  EXPECT_NEAR(*sample.speed_m_s, 5, 1e-9);
  EXPECT_NEAR(*sample.course_rad, 0.92729, 1e-4);
  EXPECT_NEAR(*sample.climb_m_s, 0.5, 1e-9);
  EXPECT_NEAR(*sample.dop, 1.5, 1e-9);
  EXPECT_EQ(sample.tracked, 11);
  // Two axes of 1.41 m make a horizontal error of 2 m.
  EXPECT_NEAR(std::hypot(*sample.position_std_m, *sample.position_std_m), 2, 1e-9);
  EXPECT_NEAR(*sample.height_std_m, 3, 1e-9);
  EXPECT_NEAR(*sample.velocity_std_m_s, 0.25, 1e-9);
}

TEST_F(UbxSamples, WithoutAFixThereIsNoPlaceAndNoClock) {
  ubx::NavPvt pvt = good_fix();
  pvt.fix_ok = false;
  take(ubx::encode_nav_pvt(pvt));
  EXPECT_FALSE(gps().latitude_rad || gps().speed_m_s || gps().position_std_m || gps().dop);
  EXPECT_EQ(gps().time_utc_ns, kNoon_ns - 400'000);
  EXPECT_FALSE(newest().utc_is_known);
  pvt = good_fix();
  pvt.position_invalid = true;
  take(ubx::encode_nav_pvt(pvt));
  EXPECT_FALSE(gps().latitude_rad);
}

TEST_F(UbxSamples, TheClockNeedsValidTimeResolvedSecondsAndASmallError) {
  const auto known = [this](const ubx::NavPvt& pvt) {
    take(ubx::encode_nav_pvt(pvt));
    return newest().utc_is_known;
  };
  ubx::NavPvt pvt = good_fix();
  pvt.fully_resolved = false;
  EXPECT_FALSE(known(pvt));
  EXPECT_FALSE(gps().leap_known);
  pvt = good_fix();
  pvt.date_valid = false;
  EXPECT_FALSE(known(pvt));
  EXPECT_FALSE(gps().time_utc_ns || newest().stated_utc_ns);
  pvt = good_fix();
  pvt.time_accuracy_s = 2e-3;
  EXPECT_FALSE(known(pvt));
  EXPECT_TRUE(gps().leap_known);
  pvt = good_fix();
  pvt.fix_type = 5;  // time alone
  EXPECT_TRUE(known(pvt));
  EXPECT_FALSE(gps().latitude_rad);
}

TEST_F(UbxSamples, NavTimeGpsTellsWhetherTheLeapSecondsAreKnown) {
  ubx::NavTimeGps time;
  time.leap_s = 18;
  take(ubx::encode_nav_timegps(time));
  take(ubx::encode_nav_pvt(good_fix()));
  EXPECT_FALSE(gps().leap_known);
  EXPECT_FALSE(newest().utc_is_known);
  time.leap_valid = true;
  take(ubx::encode_nav_timegps(time));
  take(ubx::encode_nav_pvt(good_fix()));
  EXPECT_TRUE(gps().leap_known);
  EXPECT_TRUE(newest().utc_is_known);
}

TEST_F(UbxSamples, AFlatFixHasTheHorizontalDop) {
  ubx::NavPvt pvt = good_fix();
  pvt.fix_type = 2;
  take(ubx::encode_nav_pvt(pvt));
  EXPECT_NEAR(*gps().dop, 1.5, 1e-9) << "before the first NAV-DOP";
  ubx::NavDop dop;
  dop.horizontal = 0.9;
  take(ubx::encode_nav_dop(dop));
  take(ubx::encode_nav_pvt(pvt));
  EXPECT_NEAR(*gps().dop, 0.9, 1e-9);
  take(ubx::encode_nav_pvt(good_fix()));
  EXPECT_NEAR(*gps().dop, 1.5, 1e-9);
}

TEST_F(UbxSamples, BelowTheGateThereIsNoCourse) {
  ubx::NavPvt pvt = good_fix();
  pvt.ground_speed_m_s = settings.gps.course_gate_m_s - 0.01;
  take(ubx::encode_nav_pvt(pvt));
  EXPECT_TRUE(gps().speed_m_s);
  EXPECT_FALSE(gps().course_rad);
}

TEST_F(UbxSamples, ValuesThatCannotBe) {
  ubx::NavPvt pvt = good_fix();
  pvt.latitude_deg = 91;
  take(ubx::encode_nav_pvt(pvt));
  pvt = good_fix();
  pvt.longitude_deg = -181;
  take(ubx::encode_nav_pvt(pvt));
  pvt = good_fix();
  pvt.date.month = 13;
  take(ubx::encode_nav_pvt(pvt));
  take(ubx::encode_frame(ubx::kNavPvt, std::vector<std::uint8_t>(20)));
  take(ubx::encode_frame(ubx::kNavSat, std::vector<std::uint8_t>{0, 0, 0, 0, 1, 9, 0, 0}));
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(5, Verdict::out_of_range));
  EXPECT_TRUE(collector.measurements.empty());
  take(ubx::encode_frame(0x0215, std::vector<std::uint8_t>(16)));  // RXM-RAWX
  EXPECT_EQ(collector.verdicts.back(), Verdict::ignored);
}

/// A payload of numbers at their offsets, least significant byte first.
std::vector<std::uint8_t> ubx_payload(std::size_t length,
                                      std::initializer_list<std::pair<std::size_t, std::int32_t>> numbers) {
  std::vector<std::uint8_t> bytes(length);
  for (const auto& [at, number] : numbers) protocols::put_le(&bytes[at], number);
  return bytes;
}

constexpr double kDegree = std::numbers::pi / 180;

TEST_F(UbxSamples, TheLineBetweenTwoAntennasIsATrueHeading) {
  // 1.2345 m north, 0.8 m west, 0.05 m up; 327.1 degrees, accurate to 0.4.
  const auto line = [](std::int32_t flags) {
    return ubx_payload(64, {{0, 1},
                            {8, 123},
                            {12, -80},
                            {16, -5},
                            {24, 32'710'000},
                            {32, 45},
                            {36, 100},
                            {40, 120},
                            {44, 200},
                            {52, 40'000},
                            {60, flags}});
  };
  take(ubx::encode_frame(ubx::kNavRelPosNed, line(0x137)));  // fixed, moving base, heading valid
  const auto places = collector.all<ScalarSample>();
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].quantity.view(), "relative north");
  EXPECT_NEAR(places[0].value, 1.2345, 1e-12);
  EXPECT_NEAR(places[1].value, -0.8, 1e-12);
  EXPECT_NEAR(places[2].value, -0.05, 1e-12);
  EXPECT_NEAR(*places[2].value_std, 0.02, 1e-12);
  const auto headings = collector.all<CompassSample>();
  ASSERT_EQ(headings.size(), 1U);
  EXPECT_NEAR(*headings[0].heading_rad, 327.1 * kDegree, 1e-9);
  EXPECT_TRUE(headings[0].heading_is_true);
  EXPECT_NEAR(*headings[0].heading_std_rad, 0.4 * kDegree, 1e-9);
  EXPECT_FALSE(headings[0].roll_rad || headings[0].pitch_rad);
  EXPECT_FALSE(newest().paces);
  take(ubx::encode_frame(ubx::kNavRelPosNed, line(0x037)));  // without a valid heading
  EXPECT_EQ(collector.all<CompassSample>().size(), 1U);
  EXPECT_EQ(collector.all<ScalarSample>().size(), 6U);
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(2, Verdict::used));
  take(ubx::encode_frame(ubx::kNavRelPosNed, line(0x133)));  // without a valid position: then nothing holds
  take(ubx::encode_frame(ubx::kNavRelPosNed, line(0)));
  EXPECT_EQ(collector.measurements.size(), 7U);
  EXPECT_EQ(collector.verdicts.back(), Verdict::ignored);
  // Version 0 has no heading, and other places.
  take(ubx::encode_frame(ubx::kNavRelPosNed, ubx_payload(40, {{8, 300}, {24, 100}, {36, 0x107}})));
  EXPECT_EQ(collector.all<ScalarSample>().at(6).value, 3);
  EXPECT_EQ(collector.all<CompassSample>().size(), 1U);
  take(ubx::encode_frame(ubx::kNavRelPosNed, ubx_payload(40, {{0, 1}, {36, 0x107}})));
  EXPECT_EQ(collector.verdicts.back(), Verdict::out_of_range) << "too short";
}

TEST_F(UbxSamples, AttitudesOfTheReceiverItself) {
  const auto attitude = [](std::int32_t heading_error) {
    return ubx_payload(
        32, {{8, -250'000}, {12, 1'000'000}, {16, 18'050'000}, {20, 50'000}, {24, 60'000}, {28, heading_error}});
  };
  for (const ubx::MessageCode code : {ubx::kHnrAtt, ubx::kNavAtt}) {
    take(ubx::encode_frame(code, attitude(100'000)));
    const auto sample = collector.all<CompassSample>().back();
    EXPECT_NEAR(*sample.roll_rad, -2.5 * kDegree, 1e-9);
    EXPECT_NEAR(*sample.pitch_rad, 10 * kDegree, 1e-9);
    EXPECT_NEAR(*sample.heading_rad, 180.5 * kDegree, 1e-9);
    EXPECT_TRUE(sample.heading_is_true);
    EXPECT_NEAR(*sample.tilt_std_rad, 0.6 * kDegree, 1e-9);
    EXPECT_NEAR(*sample.heading_std_rad, 1 * kDegree, 1e-9);
  }
  for (const std::int32_t no_heading : {0, 18'000'000}) {
    take(ubx::encode_frame(ubx::kHnrAtt, attitude(no_heading)));
    EXPECT_FALSE(collector.all<CompassSample>().back().heading_rad);
  }
  take(ubx::encode_frame(ubx::kHnrAtt, ubx_payload(32, {})));
  EXPECT_EQ(collector.verdicts.back(), Verdict::ignored);
  take(ubx::encode_frame(ubx::kHnrAtt, ubx_payload(31, {})));
  EXPECT_EQ(collector.verdicts.back(), Verdict::out_of_range);
}

TEST_F(UbxSamples, PositionsBetweenTheEpochsArePropagated) {
  auto payload = ubx_payload(72, {{12, 100'000'000},
                                  {20, -805'000'000},
                                  {24, 372'500'000},
                                  {28, 620'000},
                                  {32, 653'000},
                                  {36, 5'000},
                                  {44, 5'313'000},
                                  {52, 2'000},
                                  {56, 3'000},
                                  {60, 250}});
  protocols::put_le(&payload[4], std::uint16_t{2026});
  payload[6] = 11;
  payload[7] = 24;
  payload[8] = 12;
  payload[11] = 7;
  payload[16] = 4;
  payload[17] = 1;
  take(ubx::encode_frame(ubx::kHnrPvt, payload));
  ASSERT_EQ(collector.verdicts, std::vector{Verdict::used});
  EXPECT_EQ(gps().fix, Fix::propagated);
  EXPECT_EQ(gps().time_utc_ns, kNoon_ns + 100'000'000);
  EXPECT_FALSE(newest().utc_is_known);
  EXPECT_FALSE(newest().paces);
  EXPECT_NEAR(*gps().latitude_rad, 37.25 * kDegree, 1e-12);
  EXPECT_NEAR(*gps().longitude_rad, -80.5 * kDegree, 1e-12);
  EXPECT_NEAR(*gps().height_m, 620, 1e-9);
  EXPECT_NEAR(*gps().height_msl_m, 653, 1e-9);
  EXPECT_NEAR(*gps().speed_m_s, 5, 1e-9);
  EXPECT_NEAR(*gps().course_rad, 53.13 * kDegree, 1e-9);
  EXPECT_NEAR(*gps().height_std_m, 3, 1e-9);
  EXPECT_FALSE(gps().climb_m_s || gps().dop || gps().tracked);
  payload[17] = 0;
  take(ubx::encode_frame(ubx::kHnrPvt, payload));
  EXPECT_EQ(gps().fix, Fix::none);
  EXPECT_FALSE(gps().latitude_rad);
}

TEST_F(UbxSamples, SatellitesOfAllSystems) {
  ubx::NavSat sat;
  sat.count = 6;
  for (std::size_t i = 0; i < sat.count; ++i) sat.satellites[i] = {static_cast<std::uint8_t>(i), 5, 40, 30, 120};
  sat.satellites[1].number = 123;  // SBAS
  sat.satellites[4] = {6, 7, 0, -91, 0};
  sat.satellites[5].used = true;
  take(ubx::encode_nav_sat(sat));
  EXPECT_FALSE(newest().paces);
  const auto sky = std::get<SkySample>(newest().value);
  ASSERT_EQ(sky.count, 6U);
  const std::uint16_t expected[] = {5, 123, 305, 405, 71, 197};
  for (std::size_t i = 0; i < sky.count; ++i) EXPECT_EQ(sky.satellites[i].prn, expected[i]) << i;
  EXPECT_EQ(sky.satellites[0].elevation_deg, 30.0F);
  EXPECT_EQ(sky.satellites[0].azimuth_deg, 120.0F);
  EXPECT_FALSE(sky.satellites[4].elevation_deg || sky.satellites[4].azimuth_deg || sky.satellites[4].cn0_dBHz);
  EXPECT_TRUE(sky.satellites[5].used);
}

TEST_F(UbxSamples, MoreSatellitesThanASampleHolds) {
  ubx::NavSat sat;
  sat.count = 100;
  take(ubx::encode_nav_sat(sat));
  EXPECT_EQ(std::get<SkySample>(newest().value).count, SkySample::kMaxSatellites);
}

std::string rmc(int second) {
  return nmea("GNRMC,1200" + std::to_string(10 + second) + ".00,A,3715.0000,N,08030.0000,W,9.7,53.1,241126,,,A");
}

TEST_F(UbxSamples, NmeaIsReadOnlyWhereNoNavPvtComes) {
  for (int second = 0; second < 3; ++second) take(rmc(second));
  EXPECT_TRUE(collector.measurements.empty());
  EXPECT_EQ(collector.verdicts.back(), Verdict::ignored);
  take(rmc(3));  // three seconds after the first
  take(rmc(4));
  ASSERT_EQ(collector.measurements.size(), 1U);
  EXPECT_NEAR(*gps().latitude_rad, 37.25 / 180 * std::numbers::pi, 1e-9);
  take(ubx::encode_nav_pvt(good_fix()));
  collector.measurements.clear();
  for (int second = 5; second < 40; ++second) {
    take(rmc(second));
    take(ubx::encode_nav_pvt(good_fix()));
  }
  EXPECT_EQ(collector.measurements.size(), 35U) << "those of NAV-PVT";
}

TEST_F(UbxSamples, Rtcm3IsPassedOver) {
  take(protocols::test::encode_rtcm3({0x3E, 0xD0, 0, 3}));
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>{Verdict::ignored});
}

/// The documentation once more, apart from the decoder: NAV-PVT at these places of its payload.
template <class T>
T at(protocols::Bytes frame, std::size_t offset) {
  T value{};
  std::memcpy(&value, frame.data() + 6 + offset, sizeof value);
  return value;
}

TEST(UbxCapture, SamplesOfACaptureByOthers) {
  const auto stream = protocols::test::shared_capture("ubx/pygpsdata-MIXED.log");
  if (stream.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
  const auto receiver = make_instrument(config::default_port("gps", protocols::Protocol::ubx, 38400));
  Collector collector(*receiver);
  ubx::PortParser parser;
  std::size_t positions = 0, lists = 0;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    collector.measurements.clear();
    EXPECT_NE(receiver->read(frame, collector), Verdict::out_of_range) << frame.id.view();
    if (frame.id.view() == "NAV-SAT") lists += collector.all<SkySample>().size();
    if (frame.id.view() != "NAV-PVT") return;
    ++positions;
    ASSERT_EQ(collector.measurements.size(), 1U);
    const auto sample = collector.all<GpsSample>().at(0);
    if (at<std::uint8_t>(frame.bytes, 20) < 2) return;
    EXPECT_NEAR(*sample.latitude_rad, at<std::int32_t>(frame.bytes, 28) * 1e-7 * kDegree, 1e-12);
    EXPECT_NEAR(*sample.longitude_rad, at<std::int32_t>(frame.bytes, 24) * 1e-7 * kDegree, 1e-12);
    EXPECT_NEAR(*sample.height_m, at<std::int32_t>(frame.bytes, 32) * 1e-3, 1e-9);
    EXPECT_NEAR(*sample.position_std_m, at<std::uint32_t>(frame.bytes, 40) * 1e-3 * std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(*sample.height_std_m, at<std::uint32_t>(frame.bytes, 44) * 1e-3, 1e-9);
    EXPECT_NEAR(*sample.speed_m_s, at<std::int32_t>(frame.bytes, 60) * 1e-3, 1e-9);
    EXPECT_NEAR(*sample.velocity_std_m_s, at<std::uint32_t>(frame.bytes, 68) * 1e-3, 1e-9);
    EXPECT_NEAR(*sample.climb_m_s, at<std::int32_t>(frame.bytes, 56) * -1e-3, 1e-9);
  });
  EXPECT_EQ(positions, 39U);
  EXPECT_EQ(lists, 28U);
}

}  // namespace
}  // namespace navcal::instruments
