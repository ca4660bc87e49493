// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_position.h"

#include <gtest/gtest.h>

#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

template <class Decode>
auto read(Decode decode, std::string_view body) {
  const std::string text = line(body);
  return decode(nmea::Sentence(bytes_of(text)));
}

TEST(NmeaGga, Whole) {
  const auto gga =
      read(nmea::decode_gga, "GPGGA,171245.25,5209.7838,N,02048.4819,W,1,05,5.3,76.6,M,36.5,M,2.0,0120");
  ASSERT_TRUE(gga);
  EXPECT_EQ(gga->time, (TimeOfDay{17, 12, 45, 250'000'000}));
  EXPECT_NEAR(gga->place->latitude_deg, 52 + 9.7838 / 60, 1e-13);
  EXPECT_NEAR(gga->place->longitude_deg, -(20 + 48.4819 / 60), 1e-13);
  EXPECT_EQ(gga->quality, 1);
  EXPECT_EQ(gga->satellites, 5);
  EXPECT_EQ(gga->hdop->value(), 5.3);
  EXPECT_EQ(gga->altitude_m->value(), 76.6);
  EXPECT_EQ(gga->geoid_separation_m->value(), 36.5);
  EXPECT_EQ(gga->correction_age_s->value(), 2.0);
  EXPECT_EQ(gga->station, 120);
  EXPECT_EQ(gga->fix(), Fix::fix_3d);
}

TEST(NmeaGns, TheFixOfSeveralSystemsIsTheBestOfThem) {
  const auto gns =
      read(nmea::decode_gns, "GNGNS,112257.50,3844.2401,N,00908.4382,W,AAN,17,0.7,61.3,48.2,1.5,0031,V");
  ASSERT_TRUE(gns);
  EXPECT_EQ(gns->time, (TimeOfDay{11, 22, 57, 500'000'000}));
  EXPECT_NEAR(gns->place->longitude_deg, -(9 + 8.4382 / 60), 1e-13);
  EXPECT_EQ(gns->satellites, 17);
  EXPECT_EQ(gns->hdop->value(), 0.7);
  EXPECT_EQ(gns->altitude_m->value(), 61.3);
  EXPECT_EQ(gns->geoid_separation_m->value(), 48.2);
  EXPECT_EQ(gns->correction_age_s->value(), 1.5);
  EXPECT_EQ(gns->station, 31);
  const auto of_mode = [](const std::string& mode) {
    return read(nmea::decode_gns, "GNGNS,112257,3844.2401,N,00908.4382,W," + mode + ",17,0.7,61.3,48.2,,");
  };
  EXPECT_EQ(of_mode("NA")->fix(), Fix::fix_3d);
  EXPECT_EQ(of_mode("NR")->quality, 4);
  EXPECT_EQ(of_mode("ENN")->fix(), Fix::propagated);
  EXPECT_EQ(of_mode("NNNN")->fix(), Fix::none);
  EXPECT_EQ(of_mode("")->fix(), Fix::none);
  EXPECT_FALSE(of_mode("AX"));
}

TEST(NmeaGga, EmptyFieldsAreAbsent) {
  const auto gga = read(nmea::decode_gga, "GPGGA,,,,,,0,,,,M,,M,,");
  ASSERT_TRUE(gga);
  EXPECT_FALSE(gga->time || gga->place || gga->satellites || gga->hdop || gga->altitude_m || gga->station);
  EXPECT_EQ(gga->fix(), Fix::none);
}

TEST(NmeaGga, FixClaimsNoMoreThanTheSentenceShows) {
  const std::string place = "GPGGA,171245,5209.7838,N,02048.4819,E,";
  EXPECT_EQ(read(nmea::decode_gga, place + "1,03,5.3,76.6,M,,M,,")->fix(), Fix::fix_2d) << "height held";
  EXPECT_EQ(read(nmea::decode_gga, place + "1,04,5.3,76.6,M,,M,,")->fix(), Fix::fix_3d) << "four suffice";
  EXPECT_EQ(read(nmea::decode_gga, place + "1,,5.3,76.6,M,,M,,")->fix(), Fix::fix_3d)
      << "their number is not said";
  EXPECT_EQ(read(nmea::decode_gga, place + "1,08,5.3,,M,,M,,")->fix(), Fix::fix_2d);
  EXPECT_EQ(read(nmea::decode_gga, place + "4,08,5.3,1,M,,M,,")->fix(), Fix::fix_3d);
  EXPECT_EQ(read(nmea::decode_gga, place + "6,08,5.3,1,M,,M,,")->fix(), Fix::propagated);
  EXPECT_EQ(read(nmea::decode_gga, place + "0,08,5.3,1,M,,M,,")->fix(), Fix::none);
  EXPECT_EQ(read(nmea::decode_gga, "GPGGA,171245,,,,,1,08,5.3,1,M,,M,,")->fix(), Fix::none);
}

TEST(NmeaGga, WhatCannotBeIsRefused) {
  for (const char* fields :
       {"246000,5209.7838,N,02048.4819,E", "176000,5209.7838,N,02048.4819,E", "171261,5209.7838,N,02048.4819,E",
        "1712,5209.7838,N,02048.4819,E", "171245x,5209.7838,N,02048.4819,E", "171245.0x,5209.7838,N,02048.4819,E",
        "171245,9000.0001,N,02048.4819,E", "171245,5260.0,N,02048.4819,E", "171245,5209.7838,X,02048.4819,E",
        "171245,5209.7838,N,18000.0001,E", "171245,5209.7838,N,02048.4819,N", "171245,52,N,02048.4819,E",
        "171245,52-9.7,N,02048.4819,E", "171245,-209.7,N,02048.4819,E", "171245,5209.7838,,02048.4819,E",
        "171245,5209.7838,N,02048.4e19,E"}) {
    EXPECT_FALSE(read(nmea::decode_gga, std::string("GPGGA,") + fields + ",1,05,5.3,76.6,M,36.5,M,,")) << fields;
  }
  EXPECT_FALSE(read(nmea::decode_gga, "GPGGA,,,,,,1,-5,5.3,76.6,M,36.5,M,,"));
  EXPECT_FALSE(read(nmea::decode_gga, "GPGGA,,,,,,1,05,-5.3,76.6,M,36.5,M,,"));
  EXPECT_FALSE(read(nmea::decode_gga, "GPGGA,,,,,,1,05,nan,76.6,M,36.5,M,,"));
}

TEST(NmeaGga, PolesAndDateLine) {
  const auto pole = read(nmea::decode_gga, "GPGGA,235960,9000.0000,S,18000.0000,W,1,05,1,0,M,,M,,");
  ASSERT_TRUE(pole);
  EXPECT_EQ(pole->time->second, 60) << "leap second";
  EXPECT_EQ(pole->place->latitude_deg, -90);
  EXPECT_EQ(pole->place->longitude_deg, -180);
}

TEST(NmeaRmc, Whole) {
  const auto rmc = read(nmea::decode_rmc, "GPRMC,094737,A,5251.0093,N,00518.8170,E,5.6,230.5,200818,1.4,W,A");
  ASSERT_TRUE(rmc);
  EXPECT_TRUE(rmc->valid);
  EXPECT_EQ(rmc->date, (Date{2018, 8, 20}));
  EXPECT_EQ(rmc->speed_kn->value(), 5.6);
  EXPECT_EQ(rmc->course_deg->value(), 230.5);
  EXPECT_EQ(rmc->variation_deg->value(), -1.4);
  EXPECT_EQ(rmc->mode, 'A');
  EXPECT_EQ(rmc->fix(), Fix::fix_2d);
}

TEST(NmeaRmc, FixFollowsStatusAndMode) {
  const std::string head = "GPRMC,094737,";
  const std::string place = ",5251.0093,N,00518.8170,E,5.6,230.5,200818,,,";
  EXPECT_EQ(read(nmea::decode_rmc, head + "V" + place + "A")->fix(), Fix::none);
  EXPECT_EQ(read(nmea::decode_rmc, head + "A" + place + "N")->fix(), Fix::none);
  EXPECT_EQ(read(nmea::decode_rmc, head + "A" + place + "E")->fix(), Fix::propagated);
  EXPECT_FALSE(read(nmea::decode_rmc, head + "X" + place + "A"));
}

TEST(NmeaRmc, DatesAreOfTheCalendar) {
  const auto with_date = [](const std::string& date) {
    return read(nmea::decode_rmc, "GPRMC,094737,A,,,,,,," + date + ",,");
  };
  EXPECT_EQ(with_date("290224")->date, (Date{2024, 2, 29}));
  EXPECT_EQ(with_date("060180")->date, (Date{1980, 1, 6}));
  EXPECT_FALSE(with_date("290223"));
  EXPECT_FALSE(with_date("000000"));
  EXPECT_FALSE(with_date("2018"));
  EXPECT_FALSE(with_date("20081x"));
  EXPECT_FALSE(with_date("-20081"));
}

TEST(NmeaVtg, Whole) {
  const auto vtg = read(nmea::decode_vtg, "GPVTG,230.5,T,229.1,M,5.6,N,10.4,K,A");
  ASSERT_TRUE(vtg);
  EXPECT_EQ(vtg->course_true_deg->value(), 230.5);
  EXPECT_EQ(vtg->course_magnetic_deg->value(), 229.1);
  EXPECT_EQ(vtg->speed_kn->value(), 5.6);
  EXPECT_EQ(vtg->speed_km_h->value(), 10.4);
  EXPECT_EQ(vtg->mode, 'A');
  EXPECT_FALSE(read(nmea::decode_vtg, "GPVTG,230.5,229.1,5.6,10.4")) << "the form without letters is ambiguous";
  EXPECT_TRUE(read(nmea::decode_vtg, "GPVTG,,T,,M,,N,,K,N"));
  EXPECT_FALSE(read(nmea::decode_vtg, "GPVTG,361,T,,M,,N,,K,N"));
}

TEST(NmeaGll, Whole) {
  const auto gll = read(nmea::decode_gll, "GPGLL,5209.7838,N,02048.4819,E,171245.00,A");
  ASSERT_TRUE(gll);
  EXPECT_EQ(gll->fix(), Fix::fix_2d);
  EXPECT_EQ(gll->time, (TimeOfDay{17, 12, 45, 0}));
  EXPECT_EQ(read(nmea::decode_gll, "GPGLL,,,,,,V,N")->fix(), Fix::none);
}

TEST(NmeaGsa, SatellitesInUse) {
  const auto gsa = read(nmea::decode_gsa, "GPGSA,A,2,02,04,27,,,,,,,,,,,5.3,");
  ASSERT_TRUE(gsa);
  EXPECT_EQ(gsa->fix, Fix::fix_2d);
  EXPECT_EQ(gsa->count, 3U);
  EXPECT_EQ(gsa->satellites[2], 27);
  EXPECT_FALSE(gsa->pdop);
  EXPECT_EQ(gsa->hdop->value(), 5.3);
  EXPECT_EQ(read(nmea::decode_gsa, "GPGSA,A,1,,,,,,,,,,,,,,,")->fix, Fix::none);
}

TEST(NmeaGsv, EmptyPlacesAndUntrackedSatellites) {
  const auto gsv = read(nmea::decode_gsv, "GPGSV,3,3,09,27,39,195,15,05,10,010,,,,,,,,,");
  ASSERT_TRUE(gsv);
  EXPECT_EQ(gsv->visible, 9);
  ASSERT_EQ(gsv->count, 2U);
  EXPECT_EQ(gsv->satellites[0].cn0_dBHz, 15);
  EXPECT_FALSE(gsv->satellites[1].cn0_dBHz);
  const auto with_signal = read(nmea::decode_gsv, "GPGSV,1,1,01,27,39,195,15,6");
  EXPECT_EQ(with_signal->count, 1U) << "NMEA 4.1 puts a signal number at the end";
  EXPECT_FALSE(read(nmea::decode_gsv, "GPGSV,1,1,01,27,91,195,15"));
  EXPECT_TRUE(read(nmea::decode_gsv, "GPGSV,1,1,00"));
  EXPECT_TRUE(read(nmea::decode_gsv, "GPGSV"));
}

TEST(NmeaZda, TimeDateAndZone) {
  const auto zda = read(nmea::decode_zda, "GPZDA,094737.5,20,08,2018,-05,30");
  ASSERT_TRUE(zda);
  EXPECT_EQ(zda->date, (Date{2018, 8, 20}));
  EXPECT_EQ(zda->time, (TimeOfDay{9, 47, 37, 500'000'000}));
  EXPECT_EQ(zda->zone_min, -330);
  EXPECT_EQ(read(nmea::decode_zda, "GPZDA,094737.5,20,08,2018,13,59")->zone_min, 839);
  EXPECT_EQ(read(nmea::decode_zda, "GPZDA,094737.5,20,08,2018,-13,-59")->zone_min, -839);
  for (const char* zone : {"14,00", "-14,00", "00,60", "00,-60"})
    EXPECT_FALSE(read(nmea::decode_zda, std::string("GPZDA,094737.5,20,08,2018,") + zone)) << zone;
  EXPECT_FALSE(read(nmea::decode_zda, "GPZDA,094737,31,02,2018,00,00"));
  EXPECT_FALSE(read(nmea::decode_zda, "GPZDA,,,,,,")->date);
  EXPECT_FALSE(read(nmea::decode_zda, "GPZDA,,,,,1109.4,00")) << "no such zone";
}

}  // namespace
}  // namespace navcal::protocols::test
