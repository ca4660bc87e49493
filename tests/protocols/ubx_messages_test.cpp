// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>

#include "protocols/ubx_receiver.h"
#include "protocols/wire_fields.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/ubx_samples.h"

namespace navcal::protocols::test {
namespace {

TEST(UbxMessages, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const ubx::NavPvt pvt = random_pvt(random);
    EXPECT_EQ(ubx::decode_nav_pvt(ubx::encode_nav_pvt(pvt)), pvt);
    const ubx::NavTimeGps time{static_cast<std::uint32_t>(random()),
                               static_cast<std::int32_t>(random()),
                               2300,
                               18,
                               chance(random),
                               chance(random),
                               chance(random),
                               on_step(random, 0, 1'000'000, 1e-9)};
    EXPECT_EQ(ubx::decode_nav_timegps(ubx::encode_nav_timegps(time)), time);
    const ubx::NavDop dop{7,
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01),
                          on_step(random, 0, 9999, 0.01)};
    EXPECT_EQ(ubx::decode_nav_dop(ubx::encode_nav_dop(dop)), dop);
    const ubx::NavSat sat = random_sat(random);
    const auto again = ubx::decode_nav_sat(ubx::encode_nav_sat(sat));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->count, sat.count);
    EXPECT_EQ(again->satellites, sat.satellites);
  }
}

TEST(UbxMessages, OfAnotherMessageOrTooShort) {
  EXPECT_FALSE(ubx::decode_nav_pvt(ubx::encode_frame(ubx::kNavPvt, Buffer(83))));
  EXPECT_TRUE(ubx::decode_nav_pvt(ubx::encode_frame(ubx::kNavPvt, Buffer(84)))) << "as generation 7 sends it";
  EXPECT_FALSE(ubx::decode_nav_pvt(ubx::encode_frame(ubx::kNavSat, Buffer(92))));
  EXPECT_FALSE(ubx::decode_nav_dop(ubx::encode_frame(ubx::kNavDop, Buffer(17))));
  EXPECT_FALSE(ubx::decode_nav_timegps(ubx::encode_frame(ubx::kNavTimeGps, Buffer(15))));
  EXPECT_FALSE(ubx::decode_nav_sat(ubx::encode_frame(ubx::kNavSat, Buffer{0, 0, 0, 0, 1, 2, 0, 0, 9, 9})));
  EXPECT_FALSE(ubx::decode_acknowledgement(ubx::encode_frame(ubx::kAckAck, Buffer{6})));
}

TEST(UbxMessages, AFixIsOneOnlyWithinItsLimits) {
  ubx::NavPvt pvt;
  pvt.fix_type = 3;
  EXPECT_EQ(pvt.fix(), Fix::none);
  pvt.fix_ok = true;
  EXPECT_EQ(pvt.fix(), Fix::fix_3d);
  pvt.position_invalid = true;
  EXPECT_EQ(pvt.fix(), Fix::none);
}

TEST(UbxMessages, TheNanosecondMayBeNegative) {
  ubx::NavPvt pvt;
  pvt.date = {2020, 1, 1};
  pvt.nanosecond = -5;
  EXPECT_FALSE(pvt.utc_ns());
  pvt.date_valid = pvt.time_valid = true;
  EXPECT_EQ(pvt.utc_ns(), 1'577'836'800'000'000'000 - 5);
  pvt.date.month = 13;
  EXPECT_FALSE(pvt.utc_ns());
  // Years that nanoseconds in 64 bits do not reach, and those before there were satellites.
  for (const std::uint16_t year : std::initializer_list<std::uint16_t>{53, 1979, 2262, 9999}) {
    pvt.date = {year, 6, 1};
    EXPECT_FALSE(pvt.utc_ns()) << year;
  }
  pvt.date = {2261, 12, 31};
  EXPECT_TRUE(pvt.utc_ns());
}

TEST(UbxMessages, Configuration) {
  constexpr std::uint32_t kUart1Baud = 0x40520001;
  const ubx::Acknowledgement refused{ubx::kCfgValset, false};
  EXPECT_EQ(ubx::decode_acknowledgement(ubx::encode_acknowledgement(refused)), refused);
  const ubx::MessageRate rate{ubx::kNavPvt, 5};
  EXPECT_EQ(ubx::decode_cfg_msg(ubx::encode_cfg_msg(rate)), rate);
  const ubx::ValueSet set{ubx::ram | ubx::flash,
                          {{ubx::kRateMeasurement_ms, 100},
                           {kUart1Baud, 115200},
                           {ubx::key_of_ubx_output(ubx::ReceiverPort::uart1), 1}}};
  const Buffer frame = ubx::encode_cfg_valset(set.layers, set.items);
  EXPECT_EQ(ubx::decode_cfg_valset(frame), set);
  // Key and value of the first item: 01 00 21 30, then 64 00.
  const Buffer first(frame.begin() + 10, frame.begin() + 16);
  EXPECT_EQ(first, (Buffer{0x01, 0x00, 0x21, 0x30, 0x64, 0x00}));
  EXPECT_FALSE(
      ubx::decode_cfg_valset(ubx::encode_frame(ubx::kCfgValset, Buffer{0, 1, 0, 0, 1, 0, 0x21, 0x30, 5})));
  EXPECT_FALSE(ubx::decode_cfg_valset(ubx::encode_frame(ubx::kCfgValset, Buffer{0, 1, 0, 0, 1, 0, 0, 0, 5})));
}

TEST(UbxMessages, VersionAndTimePulse) {
  const ubx::Version version{"EXT CORE 1.00 (f17067)", "00190000", {"FWVER=HPG 1.50", "", "GPS;GLO;GAL;BDS"}};
  EXPECT_EQ(ubx::decode_mon_ver(ubx::encode_mon_ver(version)), version);
  const ubx::Version long_texts{std::string(40, 'x'), std::string(20, 'y'), {}};
  EXPECT_EQ(ubx::decode_mon_ver(ubx::encode_mon_ver(long_texts))->software, std::string(30, 'x'));
  EXPECT_FALSE(ubx::decode_mon_ver(ubx::encode_frame(ubx::kMonVer, {}))) << "the question";
  const ubx::TimePulse pulse{216'000'000, 0.25, -4321, 2400, true, true};
  Buffer payload(16);
  put_le(&payload[0], pulse.time_of_week_ms);
  payload[7] = 0x40;
  put_le(&payload[8], pulse.quantization_ps);
  put_le(&payload[12], pulse.week);
  payload[14] = 1;
  EXPECT_EQ(ubx::decode_tim_tp(ubx::encode_frame(ubx::kTimTp, payload)), pulse);
  EXPECT_FALSE(ubx::decode_tim_tp(ubx::encode_frame(ubx::kTimTp, Buffer(15))));
  const ubx::EpochRate rate{200, 1};
  EXPECT_EQ(ubx::decode_cfg_rate(ubx::encode_cfg_rate(rate)), rate);
  const Buffer frame = ubx::encode_cfg_rate(rate);
  EXPECT_EQ(Buffer(frame.begin() + 6, frame.end() - 2), (Buffer{200, 0, 1, 0, 0, 0}));
}

TEST(UbxMessages, KeysOfThePorts) {
  using ubx::ReceiverPort;
  EXPECT_EQ(ubx::key_of_message(ubx::kNavPvt, ReceiverPort::uart1), 0x20910007U);
  EXPECT_EQ(ubx::key_of_message(ubx::kNavPvt, ReceiverPort::usb), 0x20910009U);
  EXPECT_EQ(ubx::key_of_message(ubx::kNavSat, ReceiverPort::uart2), 0x20910017U);
  EXPECT_EQ(ubx::key_of_message(ubx::kAckAck, ReceiverPort::uart1), 0U);
  EXPECT_EQ(ubx::key_of_ubx_output(ReceiverPort::uart2), 0x10760001U);
  EXPECT_EQ(ubx::key_of_nmea_output(ReceiverPort::usb), 0x10780002U);
}

/// The documentation once more, as a packed structure of the machine (little endian here as on the wire).
struct [[gnu::packed]] PvtOnWire {
  std::uint32_t tow;
  std::uint16_t year;
  std::uint8_t month, day, hour, minute, second, valid;
  std::uint32_t time_accuracy;
  std::int32_t nano;
  std::uint8_t fix, flags, flags2, satellites;
  std::int32_t longitude, latitude, height, msl;
  std::uint32_t horizontal, vertical;
  std::int32_t north, east, down, speed, heading;
  std::uint32_t speed_accuracy, heading_accuracy;
  std::uint16_t pdop;
};
static_assert(sizeof(PvtOnWire) == 78);

TEST(UbxMessages, ValuesOfACaptureByOthers) {
  const Buffer stream = shared_capture("ubx/pygpsdata-MIXED.log");
  if (stream.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
  std::size_t positions = 0, lists = 0;
  for (const Seen& seen : all_at_once<ubx::PortScanner>(stream).frames) {
    if (seen.id == ubx::id_of(ubx::kNavSat)) {
      const auto sat = ubx::decode_nav_sat(seen.bytes);
      ASSERT_TRUE(sat);
      EXPECT_EQ(seen.bytes.size(), 8 + 8 + 12 * sat->count);
      ++lists;
    }
    if (seen.id != ubx::id_of(ubx::kNavPvt)) continue;
    ++positions;
    PvtOnWire wire{};
    std::memcpy(&wire, seen.bytes.data() + 6, sizeof wire);
    const auto pvt = ubx::decode_nav_pvt(seen.bytes);
    ASSERT_TRUE(pvt);
    EXPECT_NEAR(pvt->latitude_deg, wire.latitude / 1e7, 1e-9);
    EXPECT_NEAR(pvt->longitude_deg, wire.longitude / 1e7, 1e-9);
    EXPECT_NEAR(pvt->height_msl_m, wire.msl / 1e3, 1e-6);
    EXPECT_NEAR(pvt->velocity_ned_m_s[0], wire.north / 1e3, 1e-9);
    EXPECT_NEAR(pvt->velocity_ned_m_s[2], wire.down / 1e3, 1e-9);
    EXPECT_NEAR(pvt->heading_of_motion_deg, wire.heading / 1e5, 1e-9);
    EXPECT_NEAR(pvt->time_accuracy_s, wire.time_accuracy / 1e9, 1e-12);
    EXPECT_NEAR(pvt->pdop, wire.pdop / 1e2, 1e-9);
    EXPECT_EQ(pvt->satellites, wire.satellites);
    EXPECT_EQ(pvt->nanosecond, wire.nano);
    // Two messages of one receiver agree: the ground speed is the length of the horizontal velocity.
    EXPECT_NEAR(std::hypot(pvt->velocity_ned_m_s[0], pvt->velocity_ned_m_s[1]), pvt->ground_speed_m_s, 0.002);
  }
  EXPECT_EQ(positions, 39U);
  EXPECT_EQ(lists, 28U);
}

/// Writes a number of the machine, which is little endian as the wire.
template <class T>
void lay(Buffer& payload, std::size_t at, T value) {
  std::memcpy(&payload[at], &value, sizeof value);
}

TEST(UbxMessages, TheHighRateFixHasThePlaceOfTheOrdinaryOne) {
  Buffer payload(72);
  lay<std::uint32_t>(payload, 0, 123'456'000);
  lay<std::uint16_t>(payload, 4, 2026);
  payload[6] = 11;
  payload[7] = 21;
  payload[8] = 12;
  payload[9] = 34;
  payload[10] = 56;
  payload[11] = 3;
  lay<std::int32_t>(payload, 12, -5);
  payload[16] = 3;
  payload[17] = 1;
  lay<std::int32_t>(payload, 20, -800'000'000);
  lay<std::int32_t>(payload, 24, 370'000'000);
  lay<std::int32_t>(payload, 28, 1500);
  lay<std::int32_t>(payload, 32, -2500);
  lay<std::int32_t>(payload, 36, 1250);
  lay<std::int32_t>(payload, 44, 9'000'000);
  lay<std::uint32_t>(payload, 52, 700);
  lay<std::uint32_t>(payload, 56, 900);
  lay<std::uint32_t>(payload, 60, 50);
  const auto pvt = ubx::decode_hnr_pvt(ubx::encode_frame(ubx::kHnrPvt, payload));
  ASSERT_TRUE(pvt);
  EXPECT_EQ(pvt->time_of_week_ms, 123'456'000U);
  EXPECT_EQ(pvt->date, (Date{2026, 11, 21}));
  EXPECT_EQ(pvt->second, 56);
  EXPECT_EQ(pvt->nanosecond, -5);
  EXPECT_TRUE(pvt->date_valid && pvt->time_valid && !pvt->fully_resolved);
  EXPECT_EQ(pvt->fix(), Fix::fix_3d);
  EXPECT_NEAR(pvt->longitude_deg, -80, 1e-9);
  EXPECT_NEAR(pvt->latitude_deg, 37, 1e-9);
  EXPECT_NEAR(pvt->height_m, 1.5, 1e-9);
  EXPECT_NEAR(pvt->height_msl_m, -2.5, 1e-9);
  EXPECT_NEAR(pvt->ground_speed_m_s, 1.25, 1e-9);
  EXPECT_NEAR(pvt->heading_of_motion_deg, 90, 1e-9);
  EXPECT_NEAR(pvt->horizontal_accuracy_m, 0.7, 1e-9);
  EXPECT_NEAR(pvt->vertical_accuracy_m, 0.9, 1e-9);
  EXPECT_NEAR(pvt->speed_accuracy_m_s, 0.05, 1e-9);
  EXPECT_FALSE(ubx::decode_hnr_pvt(ubx::encode_frame(ubx::kHnrPvt, Buffer(40))));
  EXPECT_FALSE(ubx::decode_hnr_pvt(ubx::encode_frame(ubx::kNavPvt, payload)));
}

TEST(UbxMessages, AnglesAndTheirAccuracies) {
  Buffer payload(32);
  for (std::size_t i = 0; i < 3; ++i) {
    lay<std::int32_t>(payload, 8 + 4 * i, (static_cast<std::int32_t>(i) - 1) * 1'000'000);
    lay<std::uint32_t>(payload, 20 + 4 * i, 50'000 * (static_cast<std::uint32_t>(i) + 1));
  }
  for (const ubx::MessageCode code : {ubx::kNavAtt, ubx::kHnrAtt}) {
    const auto attitude = ubx::decode_attitude(ubx::encode_frame(code, payload));
    ASSERT_TRUE(attitude);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(attitude->angles_deg.at(i), 10 * (static_cast<double>(i) - 1), 1e-9);
      EXPECT_NEAR(attitude->accuracies_deg.at(i), 0.5 * (static_cast<double>(i) + 1), 1e-9);
    }
  }
  EXPECT_FALSE(ubx::decode_attitude(ubx::encode_frame(ubx::kNavAtt, Buffer(31))));
  EXPECT_FALSE(ubx::decode_attitude(Buffer{0xB5}));
}

TEST(UbxMessages, ABaselineIsValidByItsFlags) {
  constexpr std::uint32_t kFixOk = 1, kRelative = 4, kHeading = 0x100, kNormalized = 0x200;
  const auto with_flags = [](std::uint8_t version, std::uint32_t flags) {
    Buffer payload(version == 0 ? 40 : 64);
    payload[0] = version;
    const std::size_t fine = version == 0 ? 20 : 32, accuracy = version == 0 ? 24 : 36;
    for (std::size_t i = 0; i < 3; ++i) {
      lay<std::int32_t>(payload, 8 + 4 * i, 100 * (static_cast<std::int32_t>(i) - 1));
      payload[fine + i] = static_cast<std::uint8_t>(-50);
      lay<std::uint32_t>(payload, accuracy + 4 * i, 120);
    }
    if (version != 0) {
      lay<std::int32_t>(payload, 24, 12'345'678);
      lay<std::uint32_t>(payload, 52, 40'000);
    }
    lay<std::uint32_t>(payload, version == 0 ? 36 : 60, flags);
    return *ubx::decode_nav_relposned(ubx::encode_frame(ubx::kNavRelPosNed, payload));
  };
  for (const std::uint8_t version : {std::uint8_t{0}, std::uint8_t{1}}) {
    const auto good = with_flags(version, kFixOk | kRelative | kHeading);
    EXPECT_TRUE(good.position_valid);
    EXPECT_NEAR(good.position_ned_m[0], -1.005, 1e-9);
    EXPECT_NEAR(good.position_ned_m[2], 0.995, 1e-9);
    EXPECT_NEAR(good.accuracies_m[1], 0.012, 1e-9);
    for (const std::uint32_t flags : {0U, kFixOk, kRelative, kFixOk | kRelative | kNormalized})
      EXPECT_FALSE(with_flags(version, flags).position_valid) << flags;
  }
  EXPECT_NEAR(with_flags(1, kFixOk | kRelative | kHeading).line.angles_deg[2], 123.45678, 1e-9);
  EXPECT_NEAR(with_flags(1, kFixOk | kRelative | kHeading).line.accuracies_deg[2], 0.4, 1e-9);
  for (const auto& without : {with_flags(1, kFixOk | kRelative), with_flags(1, kHeading),
                              with_flags(0, kFixOk | kRelative | kHeading)}) {
    EXPECT_EQ(without.line.angles_deg[2], 0);
    EXPECT_EQ(without.line.accuracies_deg[2], 0) << "no angle";
  }
  EXPECT_FALSE(ubx::decode_nav_relposned(ubx::encode_frame(ubx::kNavRelPosNed, Buffer(39))));
  Buffer cut(40);
  cut[0] = 1;
  EXPECT_FALSE(ubx::decode_nav_relposned(ubx::encode_frame(ubx::kNavRelPosNed, cut)));
}

}  // namespace
}  // namespace navcal::protocols::test
