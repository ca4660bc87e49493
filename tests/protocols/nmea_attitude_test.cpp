// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_attitude.h"

#include <gtest/gtest.h>

#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

using nmea::Type;

std::optional<nmea::Heading> heading(std::string_view body, Type type) {
  const std::string text = line(body);
  return nmea::decode_heading(nmea::Sentence(bytes_of(text)), type);
}

std::optional<nmea::Depth> depth(std::string_view body, Type type) {
  const std::string text = line(body);
  return nmea::decode_depth(nmea::Sentence(bytes_of(text)), type);
}

TEST(NmeaHeading, MagneticAndTrue) {
  const auto magnetic = heading("HCHDM,182.3,M", Type::hdm);
  ASSERT_TRUE(magnetic);
  EXPECT_EQ(magnetic->heading_deg->value(), 182.3);
  EXPECT_FALSE(magnetic->is_true);
  EXPECT_TRUE(heading("HEHDT,182.3,T", Type::hdt)->is_true);
  const auto ths = heading("HETHS,182.3,A", Type::ths);
  EXPECT_TRUE(ths->is_true);
  EXPECT_EQ(ths->mode, 'A');
  EXPECT_FALSE(heading("HCHDM,,M", Type::hdm)->heading_deg);
}

TEST(NmeaHeading, DeviationAndVariationAreSignedByTheirLetters) {
  const auto hdg = heading("SDHDG,229.8,2.5,W,1.3,E", Type::hdg);
  ASSERT_TRUE(hdg);
  EXPECT_EQ(hdg->deviation_deg->value(), -2.5);
  EXPECT_EQ(hdg->variation_deg->value(), 1.3);
  EXPECT_FALSE(heading("SDHDG,229.8,,,1.3,E", Type::hdg)->deviation_deg);
  EXPECT_FALSE(heading("SDHDG,229.8,2.5,,1.3,E", Type::hdg)) << "a magnitude without its side";
}

TEST(NmeaHeading, WhatCannotBeIsRefused) {
  EXPECT_FALSE(heading("HCHDM,360.1,M", Type::hdm));
  EXPECT_FALSE(heading("HCHDM,-0.1,M", Type::hdm));
  EXPECT_FALSE(heading("HCHDM,18O.1,M", Type::hdm));
  EXPECT_FALSE(heading("HCHDM,180.1,T", Type::hdm));
  EXPECT_FALSE(heading("GPGGA,180.1", Type::gga));
}

std::optional<nmea::Attitude> attitude(std::string_view body) {
  const std::string text = line(body);
  return nmea::decode_attitude(nmea::Sentence(bytes_of(text)));
}

TEST(NmeaAttitude, EveryMakersSentenceGivesTheSameAttitude) {
  for (const char* body :
       {"PASHR,081502.10,311.50,T,-7.25,+2.75,+0.00,0.020,0.020,0.100,1,1", "PRDID,2.75,-7.25,311.50",
        "PSAT,HPR,081502.10,311.50,2.75,-7.25,N", "PFEC,GPatt,311.50,+2.75,-7.25",
        "GNHPR,081502.10,311.50,2.75,-7.25,4,21,0.00,0999",
        "KSXT,20260301081502.10,12.02259,57.71283,86.4,311.50,2.75,54.7,5.1,-7.25,3,3,21,22,,,,,,,1.0,"}) {
    const auto found = attitude(body);
    ASSERT_TRUE(found && found->heading_deg && found->pitch_deg && found->roll_deg) << body;
    EXPECT_EQ(found->heading_deg->value(), 311.5) << body;
    EXPECT_EQ(found->pitch_deg->value(), 2.75) << body;
    EXPECT_EQ(found->roll_deg->value(), -7.25) << body;
  }
  const auto down = attitude("PHTRO,2.75,P,7.25,B"), up = attitude("PHTRO,2.75,M,7.25,T");
  EXPECT_EQ(down->pitch_deg->value(), -2.75);
  EXPECT_EQ(down->roll_deg->value(), -7.25);
  EXPECT_EQ(up->pitch_deg->value(), 2.75);
  EXPECT_EQ(up->roll_deg->value(), 7.25);
  EXPECT_FALSE(up->heading_deg);
}

TEST(NmeaAttitude, OtherSentencesOfTheMakersAndInvalidAnglesGiveNothing) {
  for (const char* body :
       {"PASHR,POS,0,05,081502.10,5742.7698,N", "PSAT,GBS,081502.10,0.1,0.1,0.2", "PFEC,GPhve,0.1,A",
        "GNHPR,081502.10,0.00,0.00,0.00,0,0,0.00,0999", "KSXT,20260301081502.10,,,,0.00,0.00,,,0.00,0,0,21,22"}) {
    const auto found = attitude(body);
    ASSERT_TRUE(found) << body;
    EXPECT_FALSE(found->heading_deg || found->pitch_deg || found->roll_deg) << body;
  }
  EXPECT_FALSE(attitude("PRDID,2.75,-7.25,361.0"));
  EXPECT_FALSE(attitude("PRDID,95.0,-7.25,311.5"));
  EXPECT_FALSE(attitude("PSAT,HPR,081502.10,311.50,2.7x,-7.25,N"));
  const auto half = attitude("PSAT,HPR,081502.10,311.50,,-7.25,N");
  EXPECT_TRUE(half->heading_deg && half->roll_deg && !half->pitch_deg) << "two antennas";
}

TEST(NmeaRot, RateAndValidity) {
  const std::string text = line("APROT,-0.007,A");
  const auto rot = nmea::decode_rot(nmea::Sentence(bytes_of(text)));
  ASSERT_TRUE(rot);
  EXPECT_EQ(rot->rate_deg_min->value(), -0.007);
  EXPECT_TRUE(rot->valid);
}

TEST(NmeaXdr, TransducersWithEmptyFields) {
  const std::string text = line("IIXDR,C,,C,AIRTEMP,A,-1.0,D,HEEL,G,2420,,MAGY");
  const auto xdr = nmea::decode_xdr(nmea::Sentence(bytes_of(text)));
  ASSERT_TRUE(xdr);
  ASSERT_EQ(xdr->count, 3U);
  EXPECT_FALSE(xdr->transducers[0].value);
  EXPECT_EQ(xdr->transducers[1].name, "HEEL");
  EXPECT_EQ(xdr->transducers[1].value->value(), -1.0);
  EXPECT_EQ(xdr->transducers[1].unit, 'D');
  EXPECT_EQ(xdr->transducers[2].unit, '\0');
}

TEST(NmeaXdr, MoreTransducersThanFitAreLeftOut) {
  std::string body = "IIXDR";
  for (int i = 0; i < 50; ++i) body += ",A,1,D,A";
  const std::string text = line(body);
  EXPECT_EQ(nmea::decode_xdr(nmea::Sentence(bytes_of(text)))->count, nmea::Xdr::kMaxTransducers);
}

// The unit is a set-up of the device: counts of 16 bits here.
TEST(NmeaPtnthtm, IsHeldToNoRange) {
  const std::string text = line("PTNTHTM,14223,N,169,N,-43,H,13641,2454");
  const auto htm = nmea::decode_ptnthtm(nmea::Sentence(bytes_of(text)));
  ASSERT_TRUE(htm);
  EXPECT_EQ(htm->heading->value(), 14223);
  EXPECT_EQ(htm->pitch->value(), 169);
  EXPECT_EQ(htm->roll->value(), -43);
  EXPECT_EQ(htm->roll_status, 'H');
  EXPECT_EQ(htm->dip->value(), 13641);
  EXPECT_EQ(htm->horizontal_field->value(), 2454);
}

TEST(NmeaDepth, MetresAreTakenFirst) {
  EXPECT_EQ(depth("SDDBT,18.0,f,5.4,M,3.0,F", Type::dbt)->depth_m, 5.4);
  EXPECT_NEAR(depth("SDDBT,18.0,f,,M,3.0,F", Type::dbt)->depth_m.value(), 5.4864, 1e-12);
  EXPECT_NEAR(depth("SDDBT,,f,,M,3.0,F", Type::dbt)->depth_m.value(), 5.4864, 1e-12);
  EXPECT_NEAR(depth("SDDBT,,f,,M,0.5,F", Type::dbt)->depth_m.value(), 0.9144, 1e-12) << "shallow water";
  EXPECT_NEAR(depth("SDDBT,0.5,f,,M,,F", Type::dbt)->depth_m.value(), 0.1524, 1e-12);
  EXPECT_EQ(depth("SDDBT,,f,0,M,,F", Type::dbt)->depth_m, 0);
  EXPECT_FALSE(depth("SDDBT,,f,,M,,F", Type::dbt)->depth_m);
  EXPECT_FALSE(depth("SDDBT,,f,-1,M,,F", Type::dbt));
}

TEST(NmeaDepth, OffsetOfTheTransducer) {
  const auto dpt = depth("SDDPT,5.3,-0.4,100", Type::dpt);
  ASSERT_TRUE(dpt);
  EXPECT_EQ(dpt->depth_m, 5.3);
  EXPECT_EQ(dpt->offset_m->value(), -0.4);
  EXPECT_EQ(dpt->range_m->value(), 100);
  EXPECT_FALSE(depth("SDDPT,,0.4,", Type::dpt)->depth_m);
}

TEST(NmeaAttitude, LimitsBelongToTheRange) {
  for (const char* body : {"PRDID,90.0,180.0,360.0", "PRDID,-90.0,-180.0,0.0"})
    EXPECT_TRUE(attitude(body)) << body;
  for (const char* body : {"PRDID,90.1,0,0", "PRDID,-90.1,0,0", "PRDID,0,180.1,0", "PRDID,0,-180.1,0"})
    EXPECT_FALSE(attitude(body)) << body;
  const auto unsaid = attitude("PHTRO,,P,7.25,B");
  ASSERT_TRUE(unsaid);
  EXPECT_FALSE(unsaid->pitch_deg);
  EXPECT_EQ(unsaid->roll_deg->value(), -7.25);
}

}  // namespace
}  // namespace navcal::protocols::test
