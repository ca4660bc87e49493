// SPDX-License-Identifier: Apache-2.0
#include "tests/protocols/receiver_sentences.h"

#include <gtest/gtest.h>

#include "protocols/nmea_position.h"
#include "tests/protocols/gps_samples.h"
#include "tests/protocols/gps_text.h"

namespace navcal::protocols::test {
namespace {

TEST(ReceiverSentences, GgaComesBackAsItWasEncoded) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto sent = random_navigation(random);
    const auto frame = nmea::encode_gga(sent, random_satellites(random));
    const auto got = nmea::decode_gga(nmea::Sentence(frame));
    ASSERT_TRUE(got) << text_of(frame);
    EXPECT_EQ(got->time, sent.time);
    EXPECT_EQ(got->place.has_value(), sent.fix != Fix::none);
    if (!got->place) continue;
    EXPECT_NEAR(got->place->latitude_deg, sent.latitude_deg, 1e-9);
    EXPECT_NEAR(got->place->longitude_deg, sent.longitude_deg, 1e-9);
    EXPECT_NEAR(got->altitude_m->value(), sent.altitude_m, 1e-9);
    EXPECT_NEAR(got->geoid_separation_m->value(), sent.geoid_separation_m, 1e-9);
  }
}

TEST(ReceiverSentences, RmcAndVtgComeBackAsTheyWereEncoded) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto sent = random_navigation(random);
    const auto rmc_frame = nmea::encode_rmc(sent);
    const auto rmc = nmea::decode_rmc(nmea::Sentence(rmc_frame));
    const auto vtg_frame = nmea::encode_vtg(sent);
    const auto vtg = nmea::decode_vtg(nmea::Sentence(vtg_frame));
    ASSERT_TRUE(rmc && vtg) << text_of(rmc_frame) << text_of(vtg_frame);
    EXPECT_EQ(rmc->date, sent.date);
    EXPECT_EQ(rmc->time, sent.time);
    EXPECT_EQ(rmc->valid, sent.fix != Fix::none);
    if (!rmc->valid) continue;
    EXPECT_NEAR(rmc->speed_kn->value() * kMetresPerSecondPerKnot, sent.speed_m_s, 0.003);
    EXPECT_NEAR(rmc->course_deg->value(), sent.course_deg, 1e-9);
    EXPECT_NEAR(vtg->course_true_deg->value(), sent.course_deg, 1e-9);
    EXPECT_NEAR(vtg->speed_km_h->value() / 3.6, sent.speed_m_s, 0.0015);
    EXPECT_EQ(rmc->fix(), sent.fix == Fix::propagated ? Fix::propagated : Fix::fix_2d);
  }
}

TEST(ReceiverSentences, GsaAndZdaComeBackAsTheyWereEncoded) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const auto sent = random_navigation(random);
    const auto satellites = random_satellites(random);
    const auto gsa_frame = nmea::encode_gsa(sent, satellites);
    const auto gsa = nmea::decode_gsa(nmea::Sentence(gsa_frame));
    ASSERT_TRUE(gsa) << text_of(gsa_frame);
    EXPECT_EQ(gsa->count, static_cast<std::size_t>(std::count_if(satellites.begin(), satellites.end(),
                                                                 [](const auto& s) { return s.used; })));
    const auto zda_frame = nmea::encode_zda(sent);
    const auto zda = nmea::decode_zda(nmea::Sentence(zda_frame));
    ASSERT_TRUE(zda);
    EXPECT_EQ(zda->date, sent.date);
    EXPECT_EQ(zda->time, sent.time);
  }
}

TEST(ReceiverSentences, SatellitesInViewFillAsManySentencesAsTheyNeed) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const auto sent = random_satellites(random);
    const Outcome seen = all_at_once<nmea::Scanner>(nmea::encode_gsv(sent));
    ASSERT_EQ(seen.frames.size(), std::max<std::size_t>((sent.size() + 3) / 4, 1));
    std::size_t n = 0;
    for (const Seen& frame : seen.frames) {
      const auto gsv = nmea::decode_gsv(nmea::Sentence(frame.bytes));
      ASSERT_TRUE(gsv);
      EXPECT_EQ(gsv->visible, sent.size());
      for (std::size_t k = 0; k < gsv->count; ++k, ++n) {
        EXPECT_EQ(gsv->satellites[k].number, sent[n].number);
        EXPECT_EQ(gsv->satellites[k].elevation_deg, sent[n].elevation_deg);
        EXPECT_EQ(gsv->satellites[k].azimuth_deg, sent[n].azimuth_deg);
        EXPECT_EQ(gsv->satellites[k].cn0_dBHz, sent[n].cn0_dBHz);
      }
    }
    EXPECT_EQ(n, sent.size());
  }
}

TEST(ReceiverSentences, MinutesNeverReachSixty) {
  nmea::Navigation navigation;
  navigation.date = {2026, 11, 21};
  navigation.fix = Fix::fix_3d;
  navigation.latitude_deg = 36.9999999;
  navigation.longitude_deg = -80.99999999;
  navigation.course_deg = 359.96;
  const auto frame = nmea::encode_rmc(navigation);
  EXPECT_NE(text_of(frame).find("3700.0000,N,08100.0000,W"), std::string::npos) << text_of(frame);
  EXPECT_EQ(nmea::decode_rmc(nmea::Sentence(frame))->course_deg->value(), 0);
}

}  // namespace
}  // namespace navcal::protocols::test
