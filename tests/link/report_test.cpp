// SPDX-License-Identifier: Apache-2.0
#include "link/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "link/command.h"

namespace navcal::link {
namespace {

Report full_report() {
  Report r;
  r.time_utc_ms = 1'700'000'000'123;
  r.is_north_true = true;
  r.heading_deg = 359.99;
  r.pitch_deg = -12.34;
  r.roll_deg = 179.99;
  r.rate_deg_s = {-300, 0.01, 5};
  r.depth_m = 1234.567;
  r.latitude_deg = -89.1234567;
  r.longitude_deg = 179.9999999;
  r.position_std_m = 12.3;
  r.heading_std_deg = 1.25;
  r.depth_std_m = 0.021;
  r.speed_m_s = 1.234;
  r.climb_m_s = -0.5;
  r.shaft_rpm = -350;
  r.fins_deg = {1.25, -25, 0};
  r.compass_age_s = 0.1;
  r.imu_age_s = 25.4;
  r.gps_age_s = 0;
  r.motor_age_s = 3;
  r.set_alarm("leak_aft");
  r.set_alarm("link_dead");
  r.order_sequence = 65535;
  r.battery_V = 21.6;
  r.battery_charge = 0.87;
  r.priority = 7;
  r.expires_in_s = 4.25;
  r.holder = "operator";
  r.calibration = CalibrationState{"compass", 2, 77, 0x1a2b3c4d};
  return r;
}

void expect_near(const std::optional<double>& a, const std::optional<double>& b, double unit) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    EXPECT_NEAR(*a, *b, unit / 2 + 1e-12);
  }
}

TEST(LinkReport, ComesBackWithinHalfAUnit) {
  const Report r = full_report();
  const auto again = decode_report(encode_report(r));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->time_utc_ms, r.time_utc_ms);
  EXPECT_TRUE(again->is_north_true);
  expect_near(again->heading_deg, r.heading_deg, 0.01);
  expect_near(again->roll_deg, r.roll_deg, 0.01);
  for (std::size_t i = 0; i < 3; ++i) expect_near(again->rate_deg_s.at(i), r.rate_deg_s.at(i), 0.01);
  expect_near(again->depth_m, r.depth_m, 0.001);
  expect_near(again->latitude_deg, r.latitude_deg, 1e-7);
  expect_near(again->longitude_deg, r.longitude_deg, 1e-7);
  expect_near(again->speed_m_s, r.speed_m_s, 0.001);
  expect_near(again->fins_deg[1], r.fins_deg[1], 0.01);
  expect_near(again->imu_age_s, r.imu_age_s, 0.1);
  expect_near(again->battery_V, r.battery_V, 0.01);
  expect_near(again->battery_charge, r.battery_charge, 0.01);
  expect_near(again->expires_in_s, r.expires_in_s, 0.01);
  EXPECT_EQ(again->alarm_names(), (std::vector<std::string_view>{"leak_aft", "link_dead"}));
  EXPECT_EQ(again->holder, "operator");
  EXPECT_EQ(again->calibration, r.calibration);
  EXPECT_EQ(encode_report(*again), encode_report(r)) << "and is the same from then on";
}

TEST(LinkReport, HasAtMostItsBytes) {
  Report r = full_report();
  EXPECT_LT(encode_report(r).size(), 90U) << "usually";
  r.holder = r.calibration->calibrator = "a name of any length at all";
  EXPECT_EQ(encode_report(r).size(), kMaxReport);
  EXPECT_EQ(decode_report(encode_report(r))->holder, "a name of an");
}

TEST(LinkReport, AbsentStaysAbsentAndWhatIsTooLargeIsTheLargest) {
  const auto nothing = decode_report(encode_report({}));
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(nothing->time_utc_ms || nothing->heading_deg || nothing->depth_m || nothing->latitude_deg ||
               nothing->shaft_rpm || nothing->fins_deg[2] || nothing->gps_age_s || nothing->battery_charge ||
               nothing->calibration);
  Report r;
  r.depth_m = std::numeric_limits<double>::quiet_NaN();
  r.speed_m_s = 1e9;
  r.climb_m_s = -1e9;
  r.gps_age_s = 1e9;
  r.position_std_m = -1;
  const auto again = decode_report(encode_report(r));
  EXPECT_FALSE(again->depth_m);
  EXPECT_DOUBLE_EQ(*again->speed_m_s, 32.767);
  EXPECT_DOUBLE_EQ(*again->climb_m_s, -32.767);
  EXPECT_NEAR(*again->gps_age_s, 25.4, 1e-9);
  EXPECT_EQ(again->position_std_m, 0);
}

TEST(LinkReport, AnAlarmThatTheListDoesNotKnowIsShownToo) {
  Report r;
  r.set_alarm("floor");
  EXPECT_EQ(decode_report(encode_report(r))->alarm_names(), std::vector<std::string_view>{"other"});
}

TEST(LinkReport, NoPrefixIsAReportAndAnyBytesAreHarmless) {
  const Buffer whole = encode_report(full_report());
  std::size_t reports = 0;
  for (std::size_t length = 0; length < whole.size(); ++length)
    reports += decode_report(Bytes(whole).first(length)).has_value() ? 1 : 0;
  EXPECT_EQ(reports, 1U) << "only the one without the calibration";
  std::minstd_rand random(1);
  for (int i = 0; i < 2000; ++i) {
    Buffer bytes(random() % 100);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 4);
    if (!bytes.empty()) bytes[0] = 1;
    if (const auto report = decode_report(bytes)) {
      EXPECT_TRUE(decode_report(encode_report(*report)));
    }
  }
}

TEST(LinkCommand, ComesBack) {
  Command lease{Command::Kind::lease, 9, 2, 5, "operator", 0, {}};
  Command order{Command::Kind::order, 65535, 0, 0, "", -300, {1.25, -25, 0}};
  Command release{Command::Kind::release, 1, 0, 0, "", 0, {}};
  Command stop{Command::Kind::stop, 2, 0, 0, "operator", 0, {}};
  for (const Command& command : {lease, order, release, stop}) {
    EXPECT_EQ(decode_command(encode_command(command)), command);
    const Buffer whole = encode_command(command);
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_FALSE(decode_command(Bytes(whole).first(length))) << length;
  }
  order.shaft_rpm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(decode_command(encode_command(order))) << "an order that is no number is none";
  const CommandAnswer answer{7, false, false, "the lease is held by pilot (priority 1)", true};
  EXPECT_EQ(decode_answer(encode_answer(answer)), answer);
}

}  // namespace
}  // namespace navcal::link
