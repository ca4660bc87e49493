// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/angles.h"
#include "instruments/units.h"
#include "protocols/gps_stream.h"
#include "protocols/oncore_encode.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

namespace oncore = protocols::oncore;

oncore::Position position() {
  oncore::Position p;
  p.date = {2026, 3, 1};
  p.time = {12, 0, 5, 0};
  p.filtered = {57.7128, 12.0225, 123.45, std::nullopt};
  p.speed_m_s = 1.25;
  p.heading_deg = 32.0;
  p.dop = 3.5;
  p.visible = 9;
  p.tracked = 8;
  p.fix = protocols::Fix::fix_3d;
  p.channel_count = 8;
  p.channels[0] = {5, 8, 44, std::nullopt, 0x80};
  p.channels[1] = {7, 0, 30, std::nullopt, 0x80};
  return p;
}

class OncoreReceiverTest : public testing::Test {
 protected:
  void feed(const std::vector<std::uint8_t>& bytes) { collector_.feed<protocols::GpsStreamParser>(bytes); }

  Collector collector_{protocols::Protocol::oncore};
};

TEST_F(OncoreReceiverTest, PositionInSi) {
  feed(oncore::encode_ea(position()));
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(*samples[0].latitude_rad, 57.7128 * base::kRadiansPerDegree, 1e-9);
  EXPECT_NEAR(*samples[0].height_m, 123.45, 1e-9);
  EXPECT_FALSE(samples[0].height_msl_m) << "a receiver without a geoid sends 0";
  EXPECT_NEAR(*samples[0].speed_m_s, 1.25, 1e-9);
  EXPECT_NEAR(*samples[0].course_rad, 32 * base::kRadiansPerDegree, 1e-9);
  EXPECT_EQ(*samples[0].time_utc_ns, 1772366405'000000000);
  EXPECT_FALSE(samples[0].time_corrected);
}

TEST_F(OncoreReceiverTest, TimeIsNoClockUntilTheLeapSecondsAreKnown) {
  feed(oncore::encode_ea(position()));
  feed(oncore::encode_bo({std::nullopt}));
  feed(oncore::encode_ea(position()));
  feed(oncore::encode_bo({static_cast<std::int8_t>(18)}));
  feed(oncore::encode_ea(position()));
  ASSERT_EQ(collector_.measurements.size(), 3U);
  EXPECT_FALSE(collector_.measurements[0].utc_is_known);
  EXPECT_FALSE(collector_.measurements[1].utc_is_known);
  EXPECT_TRUE(collector_.measurements[2].utc_is_known);
  EXPECT_FALSE(collector_.all<GpsSample>()[1].leap_known);
}

TEST_F(OncoreReceiverTest, WeekRolloverIsUndoneAndMarked) {
  auto early = position();
  early.date = {2006, 7, 16};
  feed(oncore::encode_ea(early));
  const auto gps = collector_.all<GpsSample>()[0];
  EXPECT_TRUE(gps.time_corrected);
  EXPECT_EQ(*gps.time_utc_ns, 1772366405'000000000);
}

TEST_F(OncoreReceiverTest, PositionHoldHasNoMotion) {
  auto held = position();
  held.fix = protocols::Fix::hold;
  held.speed_m_s = held.heading_deg = held.dop = 0;
  feed(oncore::encode_ha(held));
  const auto gps = collector_.all<GpsSample>()[0];
  EXPECT_EQ(gps.fix, Fix::hold);
  EXPECT_TRUE(gps.latitude_rad);
  EXPECT_FALSE(gps.speed_m_s || gps.course_rad || gps.dop);
}

TEST_F(OncoreReceiverTest, OutOfRangeIsSaid) {
  auto wrong = position();
  wrong.date.month = 13;
  feed(oncore::encode_ea(wrong));
  ASSERT_EQ(collector_.verdicts.size(), 1U);
  EXPECT_EQ(collector_.verdicts[0], Instrument::Verdict::out_of_range);
  EXPECT_TRUE(collector_.measurements.empty());
}

TEST_F(OncoreReceiverTest, SatellitesInViewWithTheStrengthsOfTheChannels) {
  feed(oncore::encode_ea(position()));
  oncore::VisibleSatellites visible;
  visible.visible = 2;
  visible.count = 2;
  visible.satellites[0] = {5, 100, 43, 174, 0};
  visible.satellites[1] = {12, 100, 8, 20, 0};
  feed(oncore::encode_bb(visible));
  const auto skies = collector_.all<SkySample>();
  ASSERT_EQ(skies.size(), 1U);
  ASSERT_EQ(skies[0].count, 2U);
  EXPECT_TRUE(skies[0].satellites[0].used);
  EXPECT_EQ(skies[0].satellites[0].cn0_dBHz, 44);
  EXPECT_FALSE(skies[0].satellites[1].cn0_dBHz);
}

TEST_F(OncoreReceiverTest, AReceiverLeftInNmeaModeIsReadToo) {
  const std::string text = nmea("GPRMC,120000,A,5742.7698,N,01201.3554,E,10.0,54.7,010326,,,A");
  feed({text.begin(), text.end()});
  EXPECT_EQ(collector_.all<GpsSample>().size(), 1U);
}

TEST_F(OncoreReceiverTest, ReadsTheRecordedReceivers) {
  const std::string file = NAVCAL_SHARED_DIR "/captures/oncore-binary.log";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) GTEST_SKIP() << file << " is not there: recordings of others are not part of the source";
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  feed({bytes.begin(), bytes.end()});
  const auto samples = collector_.all<GpsSample>();
  ASSERT_EQ(samples.size(), 12U);
  for (const auto& gps : samples) {
    EXPECT_TRUE(gps.time_corrected);
    EXPECT_EQ(*gps.time_utc_ns / 86400'000'000'000, 18362);  // 2020-04-10
  }
  EXPECT_EQ(collector_.all<SkySample>().size(), 2U);
}

}  // namespace
}  // namespace navcal::instruments
