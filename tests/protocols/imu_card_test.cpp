// SPDX-License-Identifier: Apache-2.0
#include "protocols/imu_card.h"

#include <gtest/gtest.h>

#include "protocols/crc16.h"
#include "tests/protocols/samples.h"
#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

using imu_card::Record;

Buffer encoded(const Record& record) {
  const auto frame = imu_card::encode_record(record);
  return {frame.begin(), frame.end()};
}

std::uint16_t crc_bit_by_bit(Bytes bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x1021U : crc << 1;
    crc &= 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

TEST(Crc16, CheckValue) {
  EXPECT_EQ(crc16_ccitt_false(bytes_of("123456789")), 0x29B1);
  EXPECT_EQ(crc16_ccitt_false({}), 0xFFFF);
}

TEST(Crc16, SlicesAgreeWithTheDefinitionAtEveryLength) {
  Random random(1);
  for (std::size_t length = 0; length < 100; ++length) {
    Buffer bytes(length);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(crc16_ccitt_false(bytes), crc_bit_by_bit(bytes)) << length;
  }
}

TEST(ImuCard, WhatIsEncodedIsDecoded) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Record record = random_record(random);
    EXPECT_EQ(imu_card::decode_record(encoded(record)), record);
  }
}

TEST(ImuCard, LayoutOfTheIcd) {
  const Record record{0x12, imu_card::leak_aft | imu_card::low_supply, {0x0102, 0, 0, 0, 0, 0, 0, 65520}};
  const Buffer frame = encoded(record);
  ASSERT_EQ(frame.size(), 22U);
  EXPECT_EQ(frame[0], 0xA5);
  EXPECT_EQ(frame[1], 0x5A);
  EXPECT_EQ(frame[2], 0x12);
  EXPECT_EQ(frame[3], 0x0A);
  EXPECT_EQ(frame[4], 0x01);
  EXPECT_EQ(frame[5], 0x02);
  EXPECT_EQ(frame[18], 0xFF);
  EXPECT_EQ(frame[19], 0xF0);
  const std::uint16_t crc = crc_bit_by_bit(Bytes(frame).subspan(2, 18));
  EXPECT_EQ(frame[20], crc >> 8);
  EXPECT_EQ(frame[21], crc & 0xFF);
}

TEST(ImuCard, EveryFlippedBitIsNoticed) {
  const Buffer frame = encoded({7, 0, {0xA55A, 2048, 1, 2, 3, 4, 5, 6}});
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Buffer flipped = frame;
    flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_TRUE(all_at_once<imu_card::Scanner>(flipped).frames.empty());
    EXPECT_FALSE(imu_card::decode_record(flipped));
  }
}

TEST(ImuCard, SyncPairInsideAFrameStartsNone) {
  const Buffer frame = encoded({0xA5, 0x5A, {0xA55A, 0xA55A, 0xA55A, 0x5AA5, 0x5AA5, 0xA5A5, 0x5A5A, 0xA55A}});
  Buffer stream;
  for (int i = 0; i < 3; ++i) append(stream, frame);
  const Outcome seen = byte_by_byte<imu_card::Scanner>(stream);
  EXPECT_EQ(seen.frames.size(), 3U);
  EXPECT_EQ(seen.bad_checksum + seen.skipped_bytes, 0U);
}

TEST(ImuCard, AFailedFrameIsLeftByOneByte) {
  const Buffer frame = encoded({1, 0, {1, 2, 3, 4, 5, 6, 7, 8}});
  for (std::size_t kept = 1; kept < frame.size(); ++kept) {
    Buffer stream;
    append(stream, Bytes(frame).first(kept));
    append(stream, frame);
    append(stream, frame);  // a frame that failed by its whole length would take the second with it
    EXPECT_EQ(byte_by_byte<imu_card::Scanner>(stream).frames.size(), 2U) << kept;
  }
}

TEST(ImuCard, NothingElseIsDecoded) {
  const Buffer frame = encoded({});
  Buffer longer = frame;
  longer.resize(frame.size() + 1);
  EXPECT_FALSE(imu_card::decode_record(longer));
  EXPECT_FALSE(imu_card::decode_record(Bytes(frame).first(21)));
  EXPECT_FALSE(imu_card::decode_record({}));
}

}  // namespace
}  // namespace navcal::protocols::test
