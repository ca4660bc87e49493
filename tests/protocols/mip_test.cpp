// SPDX-License-Identifier: Apache-2.0
#include "protocols/mip.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>

#include "protocols/mip_commands.h"
#include "tests/protocols/mip_samples.h"
#include "tests/protocols/shared_capture.h"

namespace navcal::protocols::test {
namespace {

TEST(Mip, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const mip::Packet packet = random_mip_packet(random);
    EXPECT_EQ(mip::decode(mip::encode(packet)), packet);
  }
}

TEST(Mip, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<mip::Scanner>(mixture(random, random_frame<mip::Scanner>, 60)));
  }
}

TEST(Mip, EveryCutAndEveryFlippedBit) {
  Random random(4);
  Buffer stream;
  for (int i = 0; i < 3; ++i) append(stream, mip::encode(random_mip_packet(random)));
  EXPECT_TRUE(every_cut_gives_a_prefix<mip::Scanner>(stream));
  EXPECT_TRUE(every_flipped_bit_shows<mip::Scanner>(mip::encode(random_mip_packet(random))));
}

TEST(Mip, PingByteForByte) {
  EXPECT_EQ(mip::encode_command(mip::BaseCommand::ping), (Buffer{0x75, 0x65, 0x01, 0x02, 0x02, 0x01, 0xE0, 0xC6}));
  const mip::Packet reply = mip::decode(mip::encode_fields(mip::kBaseSet, {{0xF1, {0x01, 0x00}}}));
  EXPECT_EQ(reply.reply, (mip::Reply{1, 0}));
}

TEST(Mip, UnitsOfTheWire) {
  // 1.0 as a float is 3F 80 00 00: one g, one gauss, one millibar.
  const Buffer one{0x3F, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const mip::Packet packet =
      mip::decode(mip::encode_fields(mip::kSensorSet, {{0x04, one}, {0x06, one}, {0x17, {0x3F, 0x80, 0, 0}}}));
  EXPECT_DOUBLE_EQ((*packet.acceleration_m_s2)[0], 9.80665);
  EXPECT_DOUBLE_EQ((*packet.field_uT)[0], 100);
  EXPECT_DOUBLE_EQ(*packet.pressure_Pa, 100);
}

TEST(Mip, UnknownAndInvalidFieldsAreCounted) {
  const Buffer euler(12, 0);
  Buffer invalid = euler;
  invalid.insert(invalid.end(), {0, 0});
  const mip::Packet packet = mip::decode(
      mip::encode_fields(mip::kFilterSet, {{0x77, {1, 2}}, {0x05, invalid}, {0x02, euler}, {0xD5, Buffer(8, 1)}}));
  EXPECT_EQ(packet.unknown_fields, 1U);
  EXPECT_EQ(packet.invalid_fields, 2U) << "one is marked, one too short";
  EXPECT_FALSE(packet.filter_euler_rad);
  EXPECT_EQ(packet.reference_time_ns, 0x0101010101010101U);
}

TEST(Mip, AFieldOfNoLengthEndsThePacket) {
  const Buffer frame = mip::encode_fields(mip::kSensorSet, {{0xD5, Buffer(8, 0)}});
  Buffer broken = frame;
  broken[4] = 0;
  EXPECT_EQ(mip::decode(broken).invalid_fields, 1U);
  broken[4] = 200;
  EXPECT_EQ(mip::decode(broken).invalid_fields, 1U);
}

TEST(Mip, MessageFormat) {
  EXPECT_EQ(mip::encode_message_format(mip::kSensorSet, {{0x04, 10}}),
            mip::encode_fields(0x0C, {{0x0F, {1, 0x80, 1, 0x04, 0, 10}}}));
}

TEST(Mip, CommandsOfTheStartUpByteForByte) {
  EXPECT_EQ(mip::encode_base_rate_request(mip::kSensorSet, false), mip::encode_fields(0x0C, {{0x0E, {0x80}}}));
  EXPECT_EQ(mip::encode_base_rate_request(mip::kSensorSet, true), mip::encode_fields(0x0C, {{0x06, {}}}));
  EXPECT_EQ(mip::encode_base_rate_request(mip::kFilterSet, true), mip::encode_fields(0x0C, {{0x0B, {}}}));
  EXPECT_EQ(mip::encode_format_by_set(mip::kFilterSet, {{0x05, 25}}),
            mip::encode_fields(0x0C, {{0x0A, {1, 1, 0x05, 0, 25}}}));
  EXPECT_EQ(mip::encode_data_stream(mip::kFilterSet, true, false),
            mip::encode_fields(0x0C, {{0x11, {1, 0x82, 1}}}));
  EXPECT_EQ(mip::encode_data_stream(mip::kFilterSet, true, true), mip::encode_fields(0x0C, {{0x11, {1, 3, 1}}}));
}

TEST(Mip, BaseRates) {
  // 1000 Hz is 03 E8.
  const mip::Packet newer = mip::decode(mip::encode_fields(0x0C, {{0xF1, {0x0E, 0}}, {0x8E, {0x80, 3, 0xE8}}}));
  EXPECT_EQ(newer.base_rate, (mip::BaseRate{0x80, 1000}));
  const mip::Packet older = mip::decode(mip::encode_fields(0x0C, {{0xF1, {0x0B, 0}}, {0x8A, {3, 0xE8}}}));
  EXPECT_EQ(older.base_rate, (mip::BaseRate{0x82, 1000}));
  EXPECT_EQ(mip::decode(mip::encode_fields(0x0C, {{0x83, {3}}})).invalid_fields, 1U);
  EXPECT_EQ(mip::decode(mip::encode_base_rate({0x06, 0}, {0, 500})).base_rate, (mip::BaseRate{0x80, 500}));
}

TEST(Mip, AListOfFieldsOfAnotherLengthIsNone) {
  EXPECT_EQ(mip::decode_format(Buffer{2, 4, 0, 5, 5, 0, 5}).size(), 2U);
  EXPECT_TRUE(mip::decode_format(Buffer{2, 4, 0, 5}).empty());
  EXPECT_TRUE(mip::decode_format(Buffer{}).empty());
}

/// A number of the capture, read from the documentation: most significant byte first.
std::uint64_t big_endian(const Buffer& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = 256 * value + bytes[at + i];
  return value;
}

TEST(Mip, CaptureByOthers) {
  const Buffer stream = shared_capture("mip/mip_data_first.bin");
  if (stream.empty()) GTEST_SKIP() << "no capture of a MicroStrain sensor here";
  const Outcome seen = all_at_once<mip::Scanner>(stream);
  EXPECT_EQ(seen.frames.size(), 4543U);
  EXPECT_TRUE(same_however_cut<mip::Scanner>(stream));
  std::size_t with_field = 0, with_attitude = 0;
  std::uint64_t before_ns = 0;
  double force_m_s2 = 0;
  int forces = 0;
  for (const Seen& frame : seen.frames) {
    const mip::Packet packet = mip::decode(frame.bytes);
    EXPECT_EQ(packet.unknown_fields, 0U) << frame.offset;
    EXPECT_EQ(packet.invalid_fields, 0U) << frame.offset;
    for (std::size_t at = 4; at + 2 < frame.bytes.size(); at += frame.bytes[at]) {
      const auto read_float = [&](std::size_t index) {
        return double{
            std::bit_cast<float>(static_cast<std::uint32_t>(big_endian(frame.bytes, at + 2 + 4 * index, 4)))};
      };
      if (frame.bytes[at + 1] == 0xD5) {
        EXPECT_EQ(packet.reference_time_ns, big_endian(frame.bytes, at + 2, 8));
      }
      if (packet.set == 0x80 && frame.bytes[at + 1] == 0x04) {
        EXPECT_NEAR((*packet.acceleration_m_s2)[2], 9.80665 * read_float(2), 1e-9);
      }
      if (packet.set == 0x80 && frame.bytes[at + 1] == 0x06) {
        EXPECT_NEAR((*packet.field_uT)[1], 100 * read_float(1), 1e-9);
      }
      if (packet.set == 0x82 && frame.bytes[at + 1] == 0x05) {
        EXPECT_NEAR((*packet.filter_euler_rad)[0], read_float(0), 1e-9);
      }
    }
    with_field += packet.field_uT.has_value();
    with_attitude += packet.filter_euler_rad.has_value();
    if (packet.set == mip::kSensorSet && packet.rate_rad_s) {
      EXPECT_GT(*packet.reference_time_ns, before_ns) << "the device's clock goes forward";
      before_ns = *packet.reference_time_ns;
      const auto& a = *packet.acceleration_m_s2;
      force_m_s2 += std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
      ++forces;
    }
  }
  EXPECT_NEAR(force_m_s2 / forces, 9.8, 0.3) << "a sensor that is moved about feels gravity on average";
  EXPECT_EQ(with_field, 1942U);
  EXPECT_EQ(with_attitude, 387U);
}

TEST(Mip, TheFieldsOfAPacketOneByOne) {
  const auto frame = mip::encode_fields(0x0C, {{0xF1, {0x0E, 0}}, {0x8E, {0x80, 3, 0xE8}}, {0x77, {}}});
  const auto fields = mip::fields_of(frame);
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(fields[0].descriptor, 0xF1);
  EXPECT_EQ(Buffer(fields[1].data.begin(), fields[1].data.end()), (Buffer{0x80, 3, 0xE8}));
  EXPECT_EQ(fields[2].descriptor, 0x77);
  EXPECT_TRUE(fields[2].data.empty());
  for (const std::uint8_t length : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{200}}) {
    Buffer broken = frame;
    broken[8] = length;
    EXPECT_EQ(mip::fields_of(broken).size(), 1U) << "what follows a broken length is left";
  }
  EXPECT_TRUE(mip::fields_of({}).empty());
}

}  // namespace
}  // namespace navcal::protocols::test
