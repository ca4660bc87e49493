// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_messages.h"

#include <gtest/gtest.h>

#include "protocols/oncore.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_encode.h"
#include "tests/protocols/gps_samples.h"
#include "tests/protocols/gps_text.h"

namespace navcal::protocols::test {
namespace {

TEST(OncoreMessages, VisibleSatellitesComeBackAsTheyWereEncoded) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto sent = random_sky(random);
    const auto got = oncore::decode_bb(oncore::encode_bb(sent));
    ASSERT_TRUE(got);
    EXPECT_TRUE(got->in_range);
    EXPECT_EQ(got->visible, sent.visible);
    ASSERT_EQ(got->count, sent.count);
    for (std::size_t k = 0; k < got->count; ++k) {
      EXPECT_EQ(got->satellites[k].number, sent.satellites[k].number);
      EXPECT_EQ(got->satellites[k].doppler_Hz, sent.satellites[k].doppler_Hz);
      EXPECT_EQ(got->satellites[k].elevation_deg, sent.satellites[k].elevation_deg);
      EXPECT_EQ(got->satellites[k].azimuth_deg, sent.satellites[k].azimuth_deg);
      EXPECT_EQ(got->satellites[k].health, sent.satellites[k].health);
    }
  }
}

TEST(OncoreMessages, ThirteenVisibleSatellitesInTwelveSlots) {
  oncore::VisibleSatellites sky;
  for (const std::uint8_t visible : {std::uint8_t{13}, std::uint8_t{255}}) {
    sky.visible = visible;
    const auto got = oncore::decode_bb(oncore::encode_bb(sky));
    EXPECT_EQ(got->visible, visible);
    EXPECT_EQ(got->count, 12U);
  }
}

TEST(OncoreMessages, SatellitesBelowTheWorldAreOutOfRange) {
  oncore::VisibleSatellites sky;
  sky.visible = 1;
  sky.satellites[0] = {5, 0, 91, 0, 0};
  EXPECT_FALSE(oncore::decode_bb(oncore::encode_bb(sky))->in_range);
  sky.satellites[0] = {5, 0, 90, 361, 0};
  EXPECT_FALSE(oncore::decode_bb(oncore::encode_bb(sky))->in_range);
}

TEST(OncoreMessages, ZeroIsNoUtcOffsetButIgnorance) {
  EXPECT_FALSE(oncore::decode_bo(oncore::encode_bo({}))->offset_s);
  EXPECT_EQ(oncore::decode_bo(oncore::encode_bo({std::int8_t{18}}))->offset_s, 18);
}

TEST(OncoreMessages, LeapAnnouncement) {
  const Buffer data{17, 18, 0x07, 0xE0, 12, 31, 17, 0, 0, 0, 0, 23, 59, 60};
  const auto got = oncore::decode_gj(oncore::encode_frame(oncore::kGj, data));
  ASSERT_TRUE(got && got->in_range);
  EXPECT_TRUE(got->pending());
  EXPECT_EQ(got->present_s, 17);
  EXPECT_EQ(got->future_s, 18);
  EXPECT_EQ(got->date, (Date{2016, 12, 31}));
  EXPECT_EQ(got->time, (TimeOfDay{23, 59, 60, 0}));
  EXPECT_FALSE(oncore::decode_gj(oncore::encode_frame(oncore::kGj, Buffer(14, 0)))->in_range);
}

TEST(OncoreMessages, TimeRaim) {
  Buffer data(71, 0);
  data[0] = 1;
  data[2] = 1;     // alarm
  data[8] = 0x01;  // accuracy 0x0102 ns
  data[9] = 0x02;
  data[10] = 0xF6;  // saw tooth -10 ns
  const auto got = oncore::decode_hn(oncore::encode_frame(oncore::kHn, data));
  ASSERT_TRUE(got);
  EXPECT_TRUE(got->pulse_on);
  EXPECT_EQ(got->solution, oncore::TimeRaim::Solution::alarm);
  EXPECT_EQ(got->accuracy_ns, 258);
  EXPECT_EQ(got->sawtooth_ns, -10);
}

TEST(OncoreMessages, IdentificationIsReadByItsLines) {
  const std::string text =
      "COPYRIGHT 1991-1996 MOTOROLA INC.\r\nSOFTWARE VER # 8\r\nMODEL #    P283T12NR1 \r\nSERIAL #\r\nOPTIONS "
      "LIST";
  const Buffer frame = oncore::encode_cj(text);
  ASSERT_EQ(frame.size(), 294U);
  const auto got = oncore::decode_cj(frame);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->size(), 287U);
  EXPECT_TRUE(got->starts_with(text));
}

TEST(OncoreMessages, DecodersTakeOnlyTheirOwnFrames) {
  const Buffer ea = oncore::encode_ea({});
  EXPECT_FALSE(oncore::decode_bb(ea));
  EXPECT_FALSE(oncore::decode_bo(ea));
  EXPECT_FALSE(oncore::decode_gj(ea));
  EXPECT_FALSE(oncore::decode_hn(ea));
  EXPECT_FALSE(oncore::decode_cj(ea));
  EXPECT_FALSE(oncore::decode_bo({}));
}

std::string hex(const Buffer& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += "0123456789ABCDEF"[byte >> 4];
    text += "0123456789ABCDEF"[byte & 15];
  }
  return text;
}

// The commands spelt out in ICD section 2.
TEST(OncoreCommand, PollsAreTheBytesOfTheControlDocument) {
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kHa, 1)), "4040486101280D0A");
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kHb, 1)), "40404862012B0D0A");
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kEa, 1)), "4040456101250D0A");
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kBo, 1)), "4040426F012C0D0A");
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kBb, 1)), "4040426201210D0A");
  EXPECT_EQ(hex(oncore::encode_poll(oncore::kCj, 1)), "4040436A290D0A");
}

TEST(OncoreCommand, WhatIsEncodedIsUnderstood) {
  for (const FrameId id : {oncore::kHa, oncore::kEa, oncore::kBb, oncore::kBo}) {
    for (const std::uint8_t rate : Buffer{0, 1, 255}) {
      const auto command = oncore::parse_command(oncore::encode_poll(id, rate));
      ASSERT_TRUE(command);
      EXPECT_EQ(command->id, id);
      EXPECT_EQ(command->rate, rate);
    }
  }
  const auto identify = oncore::parse_command(oncore::encode_poll(oncore::kCj, 0));
  ASSERT_TRUE(identify);
  EXPECT_FALSE(identify->rate);
}

TEST(OncoreCommand, WhatIsMalformedIsDropped) {
  Buffer poll = oncore::encode_poll(oncore::kHa, 1);
  EXPECT_FALSE(oncore::parse_command({}));
  EXPECT_FALSE(oncore::parse_command(Bytes(poll).first(7)));
  for (std::size_t i = 0; i < poll.size(); ++i) {
    Buffer damaged = poll;
    damaged[i] ^= 0x10;
    EXPECT_FALSE(oncore::parse_command(damaged)) << i;
  }
  poll.push_back(0);
  EXPECT_FALSE(oncore::parse_command(poll));
  EXPECT_FALSE(oncore::parse_command(oncore::encode_frame(FrameId("Zz"), Buffer{1})));
}

TEST(OncoreMessages, EveryFieldOfTimeRaim) {
  Buffer data(71, 0);
  data[1] = 1;  // of UTC
  data[3] = 2;  // method
  data[4] = 0x80;
  data[7] = 0x01;
  const auto got = oncore::decode_hn(oncore::encode_frame(oncore::kHn, data));
  ASSERT_TRUE(got);
  EXPECT_FALSE(got->pulse_on);
  EXPECT_TRUE(got->pulse_of_utc);
  EXPECT_EQ(got->solution, oncore::TimeRaim::Solution::ok);
  EXPECT_EQ(got->method, 2);
  EXPECT_EQ(got->removed, 0x80000001U);
}

}  // namespace
}  // namespace navcal::protocols::test
