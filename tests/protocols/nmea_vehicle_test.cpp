// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocols/nmea_attitude.h"
#include "protocols/nmea_position.h"
#include "tests/protocols/stream.h"

namespace navcal::protocols::test {
namespace {

constexpr std::size_t kLongestOfTheStandard = 82;

/// The frames of what was appended; every byte must be in one, and none longer than the standard allows.
std::vector<Buffer> stated_frames(const std::string& text) {
  const Buffer bytes(text.begin(), text.end());
  const Outcome seen = all_at_once<nmea::Scanner>(bytes);
  EXPECT_EQ(seen.framed_bytes, bytes.size()) << text;
  std::vector<Buffer> frames;
  for (const Seen& frame : seen.frames) {
    EXPECT_LE(frame.bytes.size(), kLongestOfTheStandard) << text;
    frames.push_back(frame.bytes);
  }
  return frames;
}

template <class Append>
Buffer stated_frame(Append append) {
  std::string text;
  append(text);
  const auto frames = stated_frames(text);
  EXPECT_EQ(frames.size(), 1U) << text;
  return frames.empty() ? Buffer{} : frames[0];
}

double number_in(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

nmea::StatedPosition random_position(Random& random) {
  nmea::StatedPosition position;
  position.date = Date{2026, 12, 31};
  position.time = TimeOfDay{23, 59, 59, 990'000'000};
  position.fix = std::array{Fix::fix_2d, Fix::fix_3d, Fix::propagated, Fix::hold}.at(below(random, 4));
  position.latitude_deg = number_in(random, -90, 90);
  position.longitude_deg = number_in(random, -180, 180);
  position.altitude_m = number_in(random, -100, 9000);
  position.geoid_separation_m = number_in(random, -100, 100);
  position.speed_m_s = number_in(random, 0, 20);
  position.course_deg = number_in(random, 0, 360);
  position.variation_deg = number_in(random, -180, 180);
  position.hdop = number_in(random, 0.5, 99);
  position.satellites = 12;
  position.north_std_m = position.east_std_m = position.height_std_m = number_in(random, 0, 9999);
  return position;
}

TEST(NmeaVehicle, PositionsComeBack) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto sent = random_position(random);
    const auto rmc_frame = stated_frame([&](std::string& out) { append_rmc(out, sent); });
    const auto gga_frame = stated_frame([&](std::string& out) { append_gga(out, sent); });
    stated_frame([&](std::string& out) { append_gst(out, sent); });
    const auto rmc = nmea::decode_rmc(nmea::Sentence(rmc_frame));
    const auto gga = nmea::decode_gga(nmea::Sentence(gga_frame));
    ASSERT_TRUE(rmc && gga) << std::string(rmc_frame.begin(), rmc_frame.end());
    EXPECT_EQ(rmc->date, sent.date);
    EXPECT_EQ(rmc->time, sent.time);
    EXPECT_TRUE(rmc->valid);
    EXPECT_NEAR(rmc->place->latitude_deg, *sent.latitude_deg, 1e-7);
    EXPECT_NEAR(gga->place->longitude_deg, *sent.longitude_deg, 1e-7);
    EXPECT_NEAR(rmc->variation_deg->value(), *sent.variation_deg, 0.051);
    EXPECT_NEAR(std::remainder(rmc->course_deg->value() - *sent.course_deg, 360), 0, 0.0051);
    EXPECT_NEAR(gga->altitude_m->value(), *sent.altitude_m, 0.051);
    EXPECT_EQ(rmc->mode, sent.fix == Fix::propagated ? 'E' : (sent.fix == Fix::hold ? 'M' : 'A'));
    EXPECT_EQ(gga->quality, sent.fix == Fix::propagated ? 6 : (sent.fix == Fix::hold ? 7 : 1));
  }
}

TEST(NmeaVehicle, WithoutAFixNothingOfAPositionIsSaid) {
  Random random(2);
  for (const Fix fix : {Fix::none, Fix::acquiring, Fix::bad_geometry}) {
    auto sent = random_position(random);
    sent.fix = fix;
    const auto rmc_frame = stated_frame([&](std::string& out) { append_rmc(out, sent); });
    const auto rmc = nmea::decode_rmc(nmea::Sentence(rmc_frame));
    EXPECT_FALSE(rmc->valid);
    EXPECT_FALSE(rmc->place || rmc->speed_kn || rmc->course_deg);
    EXPECT_EQ(rmc->mode, 'N');
    const auto gga_frame = stated_frame([&](std::string& out) { append_gga(out, sent); });
    EXPECT_EQ(nmea::decode_gga(nmea::Sentence(gga_frame))->quality, 0);
    std::string nothing;
    append_gst(nothing, sent);
    EXPECT_EQ(nothing, "");
  }
}

TEST(NmeaVehicle, MinutesAreRoundedIntoTheNextDegree) {
  nmea::StatedPosition sent;
  sent.fix = Fix::fix_3d;
  sent.latitude_deg = -(58 - 1e-9);
  sent.longitude_deg = 12;
  std::string text;
  append_gga(text, sent);
  EXPECT_EQ(text.substr(0, 41), "$GPGGA,,5800.00000,S,01200.00000,E,1,00,,");
}

TEST(NmeaVehicle, SatellitesComeBack) {
  std::vector<nmea::StatedSatellite> sent;
  for (std::uint16_t n = 1; n <= 10; ++n) sent.push_back({n, n * 9.0, n * 35.0, {}});
  sent[3].cn0_dBHz = 44;
  std::string text;
  append_gsv(text, "GP", sent);
  const auto frames = stated_frames(text);
  ASSERT_EQ(frames.size(), 3U);
  const auto first = nmea::decode_gsv(nmea::Sentence(frames[0]));
  EXPECT_EQ(first->visible, 10);
  EXPECT_EQ(first->satellites[3].cn0_dBHz, 44);
  EXPECT_EQ(first->satellites[3].azimuth_deg, 140);
  EXPECT_FALSE(first->satellites[2].cn0_dBHz);
  EXPECT_EQ(nmea::decode_gsv(nmea::Sentence(frames[2]))->count, 2U);

  nmea::StatedPosition position;
  position.fix = Fix::fix_3d;
  position.latitude_deg = position.longitude_deg = 1;
  const std::vector<std::uint16_t> used(20, 301);
  const auto frame = stated_frame([&](std::string& out) { append_gsa(out, position, used); });
  const auto gsa = nmea::decode_gsa(nmea::Sentence(frame));
  EXPECT_EQ(gsa->count, 12U) << "no more fit into a sentence";
  EXPECT_EQ(gsa->fix, Fix::fix_3d);
}

TEST(NmeaVehicle, HeadingsComeBack) {
  for (double heading_deg = -1; heading_deg <= 361; heading_deg += 0.37) {
    const auto hdt_frame = stated_frame([&](std::string& out) { nmea::append_hdt(out, heading_deg); });
    const auto hdt = nmea::decode_heading(nmea::Sentence(hdt_frame), nmea::Type::hdt);
    ASSERT_TRUE(hdt && hdt->heading_deg);
    EXPECT_LT(hdt->heading_deg->value(), 360);
    EXPECT_NEAR(std::remainder(hdt->heading_deg->value() - heading_deg, 360), 0, 0.0051);
    const auto hdg_frame = stated_frame([&](std::string& out) { nmea::append_hdg(out, heading_deg, -2.5, 8.4); });
    const auto hdg = nmea::decode_heading(nmea::Sentence(hdg_frame), nmea::Type::hdg);
    EXPECT_EQ(hdg->deviation_deg->value(), -2.5);
    EXPECT_EQ(hdg->variation_deg->value(), 8.4);
  }
}

TEST(NmeaVehicle, WhatIsNotANumberIsNotSent) {
  std::string out;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  nmea::append_hdt(out, nan);
  nmea::append_hdg(out, nan, 1, 1);
  nmea::append_rot(out, nan);
  nmea::append_dpt(out, nan, 1);
  nmea::append_vhw(out, 1, 1, nan);
  nmea::append_xdr(out, {});
  EXPECT_EQ(out, "") << "an empty HDT has misled autopilots";
  nmea::append_rot(out, -0.01);
  EXPECT_EQ(out.substr(0, 12), "$TIROT,0.0,A");
}

TEST(NmeaVehicle, TheOthersComeBack) {
  const auto rot = stated_frame([](std::string& out) { nmea::append_rot(out, -12.3); });
  EXPECT_EQ(nmea::decode_rot(nmea::Sentence(rot))->rate_deg_min->value(), -12.3);
  const auto dpt = stated_frame([](std::string& out) { nmea::append_dpt(out, 7.41, 3.2); });
  const auto depth = nmea::decode_depth(nmea::Sentence(dpt), nmea::Type::dpt);
  EXPECT_NEAR(*depth->depth_m, 7.41, 1e-9);
  EXPECT_EQ(depth->offset_m->value(), 3.2);
  std::string text;
  nmea::append_vhw(text, std::nullopt, 123.4, 1);
  stated_frames(text);
  EXPECT_EQ(text.substr(0, text.find('*')), "$VWVHW,,T,123.40,M,1.94,N,3.60,K");
  const std::array<nmea::StatedTransducer, 3> transducers{
      {{'A', -179.99, 2, 'D', "STD_HDG"}, {'A', -179.99, 2, 'D', "STD_PIT"}, {'D', 999.999, 3, 'M', "STD_DEP"}}};
  const auto xdr_frame = stated_frame([&](std::string& out) { nmea::append_xdr(out, transducers); });
  const auto xdr = nmea::decode_xdr(nmea::Sentence(xdr_frame));
  ASSERT_EQ(xdr->count, 3U);
  EXPECT_EQ(xdr->transducers[2].name, "STD_DEP");
  EXPECT_EQ(xdr->transducers[2].value->value(), 999.999);
}

// Each sentence with all of its fields, as the standard orders them.
TEST(NmeaVehicle, WholeSentencesOfAPosition) {
  nmea::StatedPosition sent;
  sent.date = Date{2026, 11, 21};
  sent.time = TimeOfDay{1, 2, 3, 450'000'000};
  sent.fix = Fix::fix_3d;
  sent.latitude_deg = -37.25;
  sent.longitude_deg = 80.5;
  sent.altitude_m = 12.34;
  sent.geoid_separation_m = -30.25;
  sent.speed_m_s = 1852.0 / 3600;
  sent.course_deg = 90;
  sent.variation_deg = -8.4;
  sent.pdop = 2;
  sent.hdop = 1.25;
  sent.vdop = 1.5;
  sent.satellites = 7;
  sent.north_std_m = 1;
  sent.east_std_m = 2;
  sent.height_std_m = 3;
  const auto body = [](auto append) {
    std::string text;
    append(text);
    return text.substr(0, text.find('*'));
  };
  EXPECT_EQ(body([&](std::string& out) { append_gga(out, sent); }),
            "$GPGGA,010203.45,3715.00000,S,08030.00000,E,1,07,1.25,12.3,M,-30.2,M,,");
  EXPECT_EQ(body([&](std::string& out) { append_rmc(out, sent); }),
            "$GPRMC,010203.45,A,3715.00000,S,08030.00000,E,1.00,90.00,211126,8.4,W,A");
  EXPECT_EQ(body([&](std::string& out) { append_gst(out, sent); }), "$GPGST,010203.45,,,,,1.00,2.00,3.00");
  const std::array<std::uint16_t, 2> used{3, 21};
  EXPECT_EQ(body([&](std::string& out) { append_gsa(out, sent, used); }),
            "$GPGSA,A,3,03,21,,,,,,,,,,,2.00,1.25,1.50");
  sent.fix = Fix::fix_2d;
  EXPECT_EQ(body([&](std::string& out) { append_gsa(out, sent, {}); }), "$GPGSA,A,2,,,,,,,,,,,,,2.00,1.25,1.50");
  sent.fix = Fix::none;
  EXPECT_EQ(body([&](std::string& out) { append_gsa(out, sent, {}); }).substr(0, 10), "$GPGSA,A,1");
  EXPECT_EQ(body([](std::string& out) { nmea::append_dbt(out, 5.4); }), "$SDDBT,,f,5.40,M,,F");
  EXPECT_EQ(body([](std::string& out) { nmea::append_vhw(out, 10, 20, 1); }),
            "$VWVHW,10.00,T,20.00,M,1.94,N,3.60,K");
}

}  // namespace
}  // namespace navcal::protocols::test
