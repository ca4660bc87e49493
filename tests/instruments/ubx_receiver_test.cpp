// SPDX-License-Identifier: Apache-2.0
#include "instruments/ubx_receiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "config/load.h"
#include "protocols/ubx_receiver.h"
#include "tests/instruments/collector.h"
#include "tests/protocols/shared_capture.h"

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
  UbxReceiver receiver{settings};
  Collector collector{receiver};

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
  take(ubx::encode_rtcm3(std::vector<std::uint8_t>{0x3E, 0xD0, 0, 3}));
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
  UbxReceiver receiver(config::default_port("gps", protocols::Protocol::ubx, 38400));
  Collector collector(receiver);
  ubx::PortParser parser;
  std::size_t positions = 0, lists = 0;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    collector.measurements.clear();
    EXPECT_NE(receiver.read(frame, collector), Verdict::out_of_range) << frame.id.view();
    if (frame.id.view() == "NAV-SAT") lists += collector.all<SkySample>().size();
    if (frame.id.view() != "NAV-PVT") return;
    ++positions;
    ASSERT_EQ(collector.measurements.size(), 1U);
    const auto sample = collector.all<GpsSample>().at(0);
    if (at<std::uint8_t>(frame.bytes, 20) < 2) return;
    constexpr double kDegree = std::numbers::pi / 180;
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
