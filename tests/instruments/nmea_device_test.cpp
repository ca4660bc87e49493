// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/angles.h"
#include "instruments/units.h"
#include "protocols/nmea.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

using protocols::nmea::Parser;

std::string epoch(const std::string& time, bool with_gga = true) {
  std::string text = nmea("GPRMC," + time + ",A,5742.7698,N,01201.3554,E,10.0,54.7,010326,,,A");
  if (with_gga) text += nmea("GPGGA," + time + ",5742.7698,N,01201.3554,E,1,08,1.01,49.4,M,37.0,M,,");
  text += nmea("GPGSA,A,3,05,07,09,13,18,21,27,30,,,,,1.94,1.01,1.66");
  return text;
}

class NmeaDeviceTest : public testing::Test {
 protected:
  Collector collector_{protocols::Protocol::nmea};
};

TEST_F(NmeaDeviceTest, OneSampleAnEpochWithAllThatItsSentencesSay) {
  for (int s = 0; s < 5; ++s) collector_.feed<Parser>(epoch("12300" + std::to_string(s) + ".00"));
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 5U);  // the first by its RMC, the others when their GGA has come
  const GpsSample& gps = samples[3];
  EXPECT_EQ(gps.fix, Fix::fix_3d);
  EXPECT_NEAR(*gps.latitude_rad / base::kRadiansPerDegree, 57.71283, 1e-9);
  EXPECT_NEAR(*gps.height_m, 86.4, 1e-9);
  EXPECT_NEAR(*gps.height_msl_m, 49.4, 1e-9);
  EXPECT_NEAR(*gps.speed_m_s, 5.14444, 1e-4);
  EXPECT_NEAR(*gps.course_rad, 54.7 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(*gps.dop, 1.94, 1e-12);
  EXPECT_EQ(*gps.time_utc_ns - *samples[2].time_utc_ns, 1'000'000'000);
}

TEST_F(NmeaDeviceTest, AnEpochWhoseClosingSentenceIsMissingIsNotLost) {
  collector_.feed<Parser>(epoch("120000.00"));
  collector_.feed<Parser>(epoch("120001.00"));
  collector_.feed<Parser>(epoch("120002.00", false));
  collector_.feed<Parser>(epoch("120003.00", false));
  collector_.feed<Parser>(epoch("120004.00", false));
  EXPECT_EQ(collector_.all<GpsSample>().size(), 5U);
}

std::string rmc_and_gga(const std::string& time, const std::string& minutes = "44.1200") {
  return nmea("GNRMC," + time + ",A,38" + minutes + ",N,00908.4000,W,1.2,75.0,010326,,,A") +
         nmea("GNGGA," + time + ",38" + minutes + ",N,00908.4000,W,1,11,0.8,60.0,M,48.0,M,,");
}

TEST_F(NmeaDeviceTest, ASystemWithoutAFixTakesNoneFromTheReceiver) {
  const std::string gps = nmea("GNGSA,A,3,05,07,09,13,,,,,,,,,1.40,0.80,1.15,1");
  const std::string flat = nmea("GNGSA,A,2,05,07,09,,,,,,,,,,2.60,2.40,1.00,1");
  const std::string glonass = nmea("GNGSA,A,1,,,,,,,,,,,,,,,,2");
  const std::string one = rmc_and_gga("090000.00"), two = rmc_and_gga("090001.00"),
                    three = rmc_and_gga("090002.00"), four = rmc_and_gga("090003.00");
  collector_.feed<Parser>(one + gps + glonass + two + glonass + gps + three + flat + glonass + four);
  collector_.feed<Parser>(nmea("GNRMC,090004.00,V,,,,,,,010326,,,N") + gps +
                          nmea("GNGGA,090004.00,,,,,0,00,99,,M,,M,,"));
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_EQ(samples[1].fix, Fix::fix_3d);
  EXPECT_EQ(samples[2].fix, Fix::fix_3d);
  EXPECT_EQ(samples[2].dop, 1.4) << "of the system that has the fix";
  EXPECT_EQ(samples[3].fix, Fix::fix_2d) << "all systems together have no more";
  EXPECT_EQ(samples[4].fix, Fix::none) << "the receiver says so";
}

TEST_F(NmeaDeviceTest, GnsIsAFixWithTheDateOfZda) {
  for (const char* time : {"235958.00", "235959.00", "000000.00", "000001.00"}) {
    const std::string date = time[0] == '2' ? "28,02,2026" : "01,03,2026";
    collector_.feed<Parser>(
        nmea(std::string("GNGNS,") + time + ",3844.1200,N,00908.4000,W,AAN,14,0.8,60.0,48.0,,") +
        nmea(std::string("GNZDA,") + time + "," + date + ",00,00"));
  }
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_EQ(samples[1].fix, Fix::fix_3d);
  EXPECT_EQ(samples[1].tracked, 14);
  EXPECT_NEAR(*samples[1].height_m, 108, 1e-9);
  EXPECT_EQ(*samples[2].time_utc_ns - *samples[1].time_utc_ns, 1'000'000'000) << "midnight, before its ZDA";
  EXPECT_EQ(*samples[3].time_utc_ns - *samples[2].time_utc_ns, 1'000'000'000);
}

TEST_F(NmeaDeviceTest, WholeSecondsAtFiveFixesASecondLoseNone) {
  for (int k = 0; k < 50; ++k)
    collector_.feed<Parser>(rmc_and_gga("0900" + std::to_string(10 + k / 5), "44.1" + std::to_string(100 + k)));
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 50U);
  for (std::size_t k = 1; k < samples.size(); ++k) {
    EXPECT_GT(*samples[k].latitude_rad, *samples[k - 1].latitude_rad) << k;
    EXPECT_EQ(samples[k].time_utc_ns.has_value(), k % 5 == 0) << "a time that repeats is none: " << k;
    EXPECT_EQ(samples[k].fix, Fix::fix_3d) << k;
  }
}

TEST_F(NmeaDeviceTest, ASecondTalkerAddsNoFix) {
  for (int k = 0; k < 10; ++k) {
    const std::string time = "09001" + std::to_string(k) + ".00";
    collector_.feed<Parser>(rmc_and_gga(time) +
                            nmea("GPGGA," + time + ",3844.1200,N,00908.4000,W,1,06,1.1,,M,,M,,"));
  }
  EXPECT_EQ(collector_.all<GpsSample>().size(), 10U);
}

TEST_F(NmeaDeviceTest, CourseAtRestIsNoise) {
  collector_.feed<Parser>(nmea("GPRMC,120000,A,5742.7698,N,01201.3554,E,0.31,320.0,010326,,,A"));
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_TRUE(samples[0].speed_m_s);
  EXPECT_FALSE(samples[0].course_rad);
}

TEST_F(NmeaDeviceTest, AVoidPositionIsNoPosition) {
  collector_.feed<Parser>(nmea("GPRMC,120000,V,,,,,,,010326,,,N"));
  for (const auto& gps : collector_.all<GpsSample>()) EXPECT_FALSE(gps.latitude_rad);
}

TEST_F(NmeaDeviceTest, SatellitesOfSeveralTalkers) {
  collector_.feed<Parser>(nmea("GPGSA,A,3,05,07,,,,,,,,,,,1.94,1.01,1.66"));
  collector_.feed<Parser>(nmea("GPGSV,2,1,05,05,43,174,44,07,58,213,46,09,20,225,40,13,62,082,47"));
  collector_.feed<Parser>(nmea("GPGSV,2,2,05,18,08,330,"));
  collector_.feed<Parser>(nmea("GLGSV,1,1,01,70,33,200,30"));
  collector_.feed<Parser>(nmea("GPGSV,1,1,01,05,43,174,45"));
  const auto skies = collector_.all<SkySample>();
  ASSERT_EQ(skies.size(), 3U);
  EXPECT_EQ(skies[0].count, 5U);
  EXPECT_TRUE(skies[0].satellites[0].used);
  EXPECT_FALSE(skies[0].satellites[2].used);
  EXPECT_FALSE(skies[0].satellites[4].cn0_dBHz);
  EXPECT_EQ(skies[1].count, 6U);
  EXPECT_EQ(skies[2].count, 2U);
}

TEST_F(NmeaDeviceTest, SatellitesInUseAreThoseOfEverySystem) {
  for (int round = 0; round < 2; ++round)
    collector_.feed<Parser>(nmea("GNGSA,A,3,05,,,,,,,,,,,,1.4,0.8,1.1") +
                            nmea("GNGSA,A,3,70,,,,,,,,,,,,1.4,0.8,1.1") +
                            nmea("GPGSV,1,1,02,05,43,174,44,07,58,213,46") + nmea("GLGSV,1,1,01,70,33,200,30"));
  const SkySample sky = collector_.all<SkySample>().back();
  ASSERT_EQ(sky.count, 3U);
  for (const auto& satellite : sky.satellites)
    EXPECT_EQ(satellite.used, satellite.prn == 5 || satellite.prn == 70);
}

TEST_F(NmeaDeviceTest, CompassesAndEchoSounders) {
  collector_.feed<Parser>(nmea("HCHDM,182.3,M") + nmea("HEHDT,10.0,T") + nmea("APXDR,A,0.135,D,PTCH") +
                          nmea("TIROT,60.0,A") + nmea("SDDPT,12.5,0.3") + nmea("HEHDT,,T"));
  const auto compass = collector_.all<CompassSample>();
  ASSERT_EQ(compass.size(), 4U);
  EXPECT_FALSE(compass[0].heading_is_true);
  EXPECT_TRUE(compass[1].heading_is_true);
  EXPECT_NEAR(*compass[2].pitch_rad, 0.135 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(*compass[3].turn_rate_rad_s, 1 * base::kRadiansPerDegree, 1e-12);
  ASSERT_EQ(collector_.all<AltimeterSample>().size(), 1U);
  EXPECT_EQ(collector_.all<AltimeterSample>()[0].altitude_m, 12.5);
}

TEST_F(NmeaDeviceTest, HdgIsCorrectedByTheDeviationThatItStates) {
  collector_.feed<Parser>(nmea("HCHDG,2.0,3.5,W,12.0,E") + nmea("HCHDG,359.0,3.5,E,,") +
                          nmea("HCHDG,90.0,,,12.0,E"));
  const auto compass = collector_.all<CompassSample>();
  ASSERT_EQ(compass.size(), 3U);
  EXPECT_NEAR(*compass[0].heading_rad, 358.5 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(*compass[1].heading_rad, 2.5 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(*compass[2].heading_rad, 90 * base::kRadiansPerDegree, 1e-12);
  for (const auto& sample : compass) EXPECT_FALSE(sample.heading_is_true);
}

TEST_F(NmeaDeviceTest, NamesOfTiltAreFreeText) {
  for (const char* body : {"IIXDR,A,4.0,D,Pitch,A,-9.0,D,Roll", "IIXDR,A,4.0,D,PTCH#2,A,-9.0,D,Heel Angle",
                           "IIXDR,A,4.0,D,PITCH#0,A,-9.0,D,ROLL#0,A,55.0,D,PITCH#1,A,55.0,D,ROLL#1"})
    collector_.feed<Parser>(nmea(body));
  const auto compass = collector_.all<CompassSample>();
  ASSERT_EQ(compass.size(), 3U);
  for (const auto& sample : compass) {
    EXPECT_NEAR(*sample.pitch_rad, 4 * base::kRadiansPerDegree, 1e-12);
    EXPECT_NEAR(*sample.roll_rad, -9 * base::kRadiansPerDegree, 1e-12);
  }
  collector_.feed<Parser>(nmea("IIXDR,A,4.0,D,RUDDER,A,4.0,D,STD_PIT,A,4.0,D,PIT"));
  EXPECT_EQ(collector_.verdicts.back(), Instrument::Verdict::ignored);
}

TEST_F(NmeaDeviceTest, AttitudeSentencesAreCompasses) {
  collector_.feed<Parser>(nmea("PASHR,081502.10,311.50,T,-7.25,+2.75,+0.00,0.020,0.020,0.100,1,1") +
                          nmea("PHTRO,2.75,M,7.25,B") + nmea("PTNTHPR,85.9,N,-0.9,N,0.8,N") +
                          nmea("PASHR,POS,0,05,081502.10"));
  const auto compass = collector_.all<CompassSample>();
  ASSERT_EQ(compass.size(), 3U);
  EXPECT_TRUE(compass[0].heading_is_true);
  EXPECT_NEAR(*compass[0].heading_rad, 311.5 * base::kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(*compass[0].roll_rad, -7.25 * base::kRadiansPerDegree, 1e-12);
  EXPECT_FALSE(compass[1].heading_rad || compass[1].heading_is_true);
  EXPECT_NEAR(*compass[1].pitch_rad, 2.75 * base::kRadiansPerDegree, 1e-12);
  EXPECT_FALSE(compass[2].heading_is_true) << "a magnetic compass";
  EXPECT_NEAR(*compass[2].roll_rad, 0.8 * base::kRadiansPerDegree, 1e-12);
  EXPECT_EQ(collector_.verdicts.back(), Instrument::Verdict::ignored);
}

TEST_F(NmeaDeviceTest, GaugesOfABattery) {
  collector_.feed<Parser>(nmea("IIXDR,U,21.3,V,BATTERY,I,-1.25,A,BATTERY") + nmea("IIXDR,U,22.0,V,BATTERY#0") +
                          nmea("IIXDR,U,12.0,V,BATTERY#1,U,5,V,LOGIC,I,1,A,MOTOR") + nmea("IIXDR,U,,V,BATTERY") +
                          nmea("IIXDR,U,3,M,BATTERY"));
  const auto power = collector_.all<PowerSample>();
  ASSERT_EQ(power.size(), 2U);
  EXPECT_EQ(power[0].voltage_V, 21.3);
  EXPECT_EQ(power[0].current_A, -1.25);
  EXPECT_EQ(power[1].voltage_V, 22.0);
  EXPECT_FALSE(power[1].current_A);
}

TEST_F(NmeaDeviceTest, GaugesWithValuesThatCannotBeGiveNothing) {
  for (const char* bad : {"IIXDR,U,-1,V,BATTERY", "IIXDR,U,1001,V,BATTERY", "IIXDR,I,1e3,A,BATTERY",
                          "IIXDR,I,-1001,A,BATTERY", "IIXDR,U,nan,V,BATTERY", "IIXDR,UU,21,V,BATTERY"})
    collector_.feed<Parser>(nmea(bad));
  EXPECT_TRUE(collector_.all<PowerSample>().empty());
}

TEST_F(NmeaDeviceTest, EchoSoundersWithoutAnEchoOrWithABadDepthGiveNothing) {
  for (const char* bad : {"SDDBT,,f,,M,,F", "SDDBT,,f,-1,M,,F", "SDDPT,,0.3,", "SDDPT,x,0.3,", "SDDBT"})
    collector_.feed<Parser>(nmea(bad));
  EXPECT_TRUE(collector_.all<AltimeterSample>().empty());
}

TEST(NmeaDevice, CountsOfSixteenBitsAreASetUpOfTheDevice) {
  config::PortSettings settings;
  settings.compass.heading_unit = settings.compass.tilt_unit = config::AngleUnit::counts16;
  settings.protocol = protocols::Protocol::nmea;
  Collector collector(settings);
  collector.feed<Parser>("$PTNTHTM,14223,N,169,N,-43,N,13641,2454*15\r\n");
  const auto samples = collector.all<CompassSample>();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(*samples[0].heading_rad / base::kRadiansPerDegree, 78.13, 0.01);
  EXPECT_NEAR(*samples[0].dip_rad / base::kRadiansPerDegree, 74.93, 0.01);
}

TEST(NmeaDevice, ReadsTheRecordedReceivers) {
  const std::string file = NAVCAL_SHARED_DIR "/captures/oncore.log";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) GTEST_SKIP() << file << " is not there: recordings of others are not part of the source";
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  Collector collector(protocols::Protocol::nmea);
  collector.feed<Parser>(bytes);
  EXPECT_GE(collector.all<GpsSample>().size(), 6U);
  EXPECT_LE(collector.all<GpsSample>().size(), 7U);
  for (const auto& gps : collector.all<GpsSample>()) EXPECT_TRUE(gps.time_utc_ns);
}

}  // namespace
}  // namespace navcal::instruments
