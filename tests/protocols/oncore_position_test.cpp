// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_position.h"

#include <gtest/gtest.h>

#include "protocols/oncore.h"
#include "protocols/oncore_encode.h"
#include "tests/protocols/gps_samples.h"

namespace navcal::protocols::test {
namespace {

using oncore::Position;

void expect_same_place(const oncore::Coordinates& a, const oncore::Coordinates& b) {
  EXPECT_NEAR(a.latitude_deg, b.latitude_deg, 1e-9);
  EXPECT_NEAR(a.longitude_deg, b.longitude_deg, 1e-9);
  EXPECT_NEAR(a.height_m, b.height_m, 1e-9);
  EXPECT_NEAR(a.height_msl_m.value(), b.height_msl_m.value(), 1e-9);
}

void expect_same_common_part(const Position& a, const Position& b) {
  EXPECT_EQ(a.in_range, b.in_range);
  EXPECT_EQ(a.date, b.date);
  EXPECT_EQ(a.time, b.time);
  expect_same_place(a.filtered, b.filtered);
  EXPECT_NEAR(a.speed_m_s, b.speed_m_s, 1e-9);
  EXPECT_NEAR(a.heading_deg, b.heading_deg, 1e-9);
  EXPECT_NEAR(a.dop, b.dop, 1e-9);
  EXPECT_EQ(a.visible, b.visible);
  EXPECT_EQ(a.tracked, b.tracked);
  EXPECT_EQ(a.antenna, b.antenna);
  EXPECT_EQ(a.few_satellites, b.few_satellites);
  EXPECT_EQ(a.no_almanac, b.no_almanac);
}

TEST(OncorePosition, HaComesBackAsItWasEncoded) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Position sent = random_position(random);
    sent.in_range = true;
    const auto got = oncore::decode_position(oncore::encode_ha(sent));
    ASSERT_TRUE(got);
    expect_same_common_part(*got, sent);
    expect_same_place(got->unfiltered.value(), sent.unfiltered.value());
    EXPECT_NEAR(got->speed_3d_m_s.value(), sent.speed_3d_m_s.value(), 1e-9);
    EXPECT_EQ(got->fix, sent.fix);
    ASSERT_EQ(got->channel_count, 12U);
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_EQ(got->channels[k].satellite, sent.channels[k].satellite);
      EXPECT_EQ(got->channels[k].cn0, sent.channels[k].cn0);
      EXPECT_EQ(got->channels[k].iode, sent.channels[k].iode);
      EXPECT_EQ(got->channels[k].status, sent.channels[k].status);
    }
    EXPECT_EQ(got->clock_bias_ns, sent.clock_bias_ns);
    EXPECT_EQ(got->oscillator_offset_Hz, sent.oscillator_offset_Hz);
    EXPECT_EQ(got->temperature_C, sent.temperature_C);
    EXPECT_EQ(got->utc->enabled, sent.utc->enabled);
    EXPECT_EQ(got->utc->decoded, sent.utc->decoded);
    EXPECT_EQ(got->utc->offset_s, sent.utc->offset_s);
    EXPECT_EQ(got->id_tag, sent.id_tag);
  }
}

TEST(OncorePosition, EaComesBackAsItWasEncoded) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Position sent = random_position(random);
    sent.in_range = true;
    const auto got = oncore::decode_position(oncore::encode_ea(sent));
    ASSERT_TRUE(got);
    expect_same_common_part(*got, sent);
    // One bit stands for both: the reading that claims less.
    EXPECT_EQ(got->fix, sent.fix == Fix::hold ? Fix::acquiring : sent.fix);
    EXPECT_EQ(got->channel_count, 8U);
    EXPECT_FALSE(got->unfiltered || got->utc || got->temperature_C || got->speed_3d_m_s);
  }
}

// Ba is Ea with six channels.
TEST(OncorePosition, BaIsReadWithSixChannels) {
  Random random(3);
  const Position sent = random_position(random);
  const Buffer ea = oncore::encode_ea(sent);
  Buffer data(ea.begin() + 4, ea.begin() + 64);
  data.push_back(0x20);
  const auto got = oncore::decode_position(oncore::encode_frame(oncore::kBa, data));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->channel_count, 6U);
  EXPECT_EQ(got->channels[5].satellite, sent.channels[5].satellite);
  EXPECT_EQ(got->fix, Fix::fix_3d);
}

TEST(OncorePosition, HbIsHaWithoutChannels) {
  Random random(4);
  const Position sent = random_position(random);
  const Buffer ha = oncore::encode_ha(sent);
  Buffer data(ha.begin() + 4, ha.begin() + 31);               // time and place
  data.insert(data.end(), ha.begin() + 47, ha.begin() + 57);  // motion and counts
  data.insert(data.end(), ha.begin() + 129, ha.begin() + 131);
  data.insert(data.end(), 2, 0);
  data.insert(data.end(), ha.begin() + 145, ha.begin() + 151);
  const auto got = oncore::decode_position(oncore::encode_frame(oncore::kHb, data));
  const auto whole = oncore::decode_position(ha);
  ASSERT_TRUE(got && whole);
  expect_same_common_part(*got, *whole);
  EXPECT_EQ(got->speed_3d_m_s, whole->speed_3d_m_s);
  EXPECT_EQ(got->fix, whole->fix);
  EXPECT_EQ(got->id_tag, whole->id_tag);
  EXPECT_EQ(got->channel_count, 0U);
}

TEST(OncorePosition, SpeedOfHaIsTheHorizontalOne) {
  Position sent;
  sent.date = {2026, 11, 21};
  sent.speed_3d_m_s = 5;
  sent.speed_m_s = 3;
  EXPECT_EQ(oncore::decode_position(oncore::encode_ha(sent))->speed_m_s, 3);
}

TEST(OncorePosition, ExtremesOfTheRangesAreInRangeAndOneMoreIsNot) {
  struct Field {
    const char* name;
    std::size_t offset, bytes;
    std::int64_t good, bad;
  };
  // ICD section 2, "Ranges to hold a frame to"; offsets are those of Ea.
  const Field fields[] = {
      {"month", 4, 1, 12, 13},
      {"month", 4, 1, 1, 0},
      {"day", 5, 1, 30, 31},
      {"day", 5, 1, 1, 0},
      {"hour", 8, 1, 23, 24},
      {"minute", 9, 1, 59, 60},
      {"second", 10, 1, 60, 61},
      {"nanosecond", 11, 4, 999'999'999, 1'000'000'000},
      {"latitude", 15, 4, 324'000'000, 324'000'001},
      {"latitude", 15, 4, -324'000'000, -324'000'001},
      {"longitude", 19, 4, 648'000'000, 648'000'001},
      {"longitude", 19, 4, -648'000'000, -648'000'001},
      {"latitude", 15, 4, 0, INT32_MIN},
      {"heading", 33, 2, 3599, 3600},
      {"DOP", 35, 2, 999, 1000},
  };
  Random random(5);
  Position sent = random_position(random);
  sent.date = {2026, 11, 21};
  const Buffer ea = oncore::encode_ea(sent);
  for (const Field& field : fields) {
    for (const bool good : {true, false}) {
      Buffer data(ea.begin() + 4, ea.end() - 3);
      std::int64_t value = good ? field.good : field.bad;
      for (std::size_t i = field.bytes; i-- > 0; value >>= 8)
        data[field.offset - 4 + i] = static_cast<std::uint8_t>(value & 0xFF);
      const auto got = oncore::decode_position(oncore::encode_frame(oncore::kEa, data));
      ASSERT_TRUE(got) << "intact, whatever it says";
      EXPECT_EQ(got->in_range, good) << field.name << ' ' << (good ? field.good : field.bad);
    }
  }
}

TEST(OncorePosition, StatusOfTwelveChannels) {
  const std::pair<std::uint16_t, Fix> meanings[] = {
      {0xE000, Fix::fix_3d},    {0xC000, Fix::fix_2d},       {0xA000, Fix::propagated}, {0x8000, Fix::hold},
      {0x6000, Fix::acquiring}, {0x4000, Fix::bad_geometry}, {0x2000, Fix::none},       {0x0000, Fix::none},
  };
  for (const auto& [status, fix] : meanings) {
    Position sent;
    sent.status = static_cast<std::uint16_t>(status | 0x008C);
    const auto got = oncore::decode_position(oncore::encode_ha(sent));
    EXPECT_EQ(got->fix, fix);
    EXPECT_TRUE(got->no_almanac && got->few_satellites);
    EXPECT_EQ(got->antenna, oncore::Antenna::open);
  }
}

TEST(OncorePosition, PositionHoldSaysZeroAndIsHold) {
  Position sent;
  sent.date = {2026, 1, 21};
  sent.fix = Fix::hold;
  sent.filtered.latitude_deg = 52.9;
  const auto got = oncore::decode_position(oncore::encode_ha(sent));
  EXPECT_TRUE(got->in_range);
  EXPECT_EQ(got->fix, Fix::hold);
  EXPECT_EQ(got->speed_m_s + got->heading_deg + got->dop, 0);
}

TEST(OncorePosition, AHeadingThatRoundsUpToTheFullCircleIsNorth) {
  Position sent;
  sent.date = {2026, 11, 21};
  sent.heading_deg = 359.97;
  const auto got = oncore::decode_position(oncore::encode_ea(sent));
  EXPECT_TRUE(got->in_range);
  EXPECT_EQ(got->heading_deg, 0);
}

TEST(OncorePosition, ReadsTheAsciiPosition) {
  const auto got = oncore::decode_position(ascii_position(kAsciiPosition));
  ASSERT_TRUE(got);
  EXPECT_TRUE(got->in_range);
  EXPECT_EQ(got->date, (Date{2026, 11, 21}));
  EXPECT_EQ(got->time, (TimeOfDay{12, 34, 56, 0}));
  EXPECT_NEAR(got->filtered.latitude_deg, 37 + 12.345 / 60, 1e-12);
  EXPECT_NEAR(got->filtered.longitude_deg, -(80 + 24.06 / 60), 1e-12);
  EXPECT_EQ(got->filtered.height_m, 540.5);
  EXPECT_NEAR(got->speed_m_s, 2.5 * 1852 / 3600, 1e-12);
  EXPECT_EQ(got->heading_deg, 123.4);
  EXPECT_EQ(got->fix, Fix::fix_3d);
  EXPECT_EQ(got->dop, 1.8);
  EXPECT_EQ(got->tracked, 7);
  EXPECT_FALSE(got->visible);
}

TEST(OncorePosition, AsciiPositionThatCannotBeRead) {
  for (std::size_t i = 0; i < kAsciiPosition.size(); ++i) {
    std::string text = kAsciiPosition;
    text[i] = '?';
    static_cast<void>(oncore::decode_position(ascii_position(text)));  // must not crash
  }
  std::string text = kAsciiPosition;
  text[6] = ' ';
  EXPECT_FALSE(oncore::decode_position(ascii_position(text)));
  text = kAsciiPosition;
  text.replace(9, 2, "24");
  const auto got = oncore::decode_position(ascii_position(text));
  ASSERT_TRUE(got);
  EXPECT_FALSE(got->in_range) << "hour 24";
}

TEST(OncorePosition, OtherFramesAreNoPositions) {
  EXPECT_FALSE(oncore::decode_position(oncore::encode_bo({})));
  EXPECT_FALSE(oncore::decode_position({}));
  Buffer cut = oncore::encode_ea({});
  cut.pop_back();
  EXPECT_FALSE(oncore::decode_position(cut));
}

TEST(OncorePosition, EaStatesTheKindOfItsDilution) {
  for (const auto& [fix, kind] : {std::pair{Fix::fix_2d, 1}, std::pair{Fix::fix_3d, 0}, std::pair{Fix::none, 0}}) {
    Position sent;
    sent.fix = fix;
    EXPECT_EQ(oncore::encode_ea(sent)[37] & 0x3F, kind) << "horizontal on two dimensions";
  }
}

TEST(OncorePosition, AnyChecksumOfTheAsciiPositionIsRead) {
  std::string text = kAsciiPosition;
  for (char ten = '0'; ten <= '9'; ++ten) {
    for (char one = '0'; one <= '9'; ++one) {
      text[9] = ten;
      text[10] = one;
      EXPECT_EQ(all_at_once<oncore::Scanner>(ascii_position(text)).frames.size(), 1U) << text;
    }
  }
}

}  // namespace
}  // namespace navcal::protocols::test
