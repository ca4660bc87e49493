// SPDX-License-Identifier: Apache-2.0
// Pressure gauges: Paroscientific and Keller.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "protocols/crc16.h"
#include "tests/protocols/pressure_samples.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

TEST(Paroscientific, LinesOfEachKind) {
  const Outcome seen = all_at_once<paroscientific::Scanner>(
      bytes_of("*000114.72317\r\n*0001UN=1\r\n*0100P4\r\n*0001-0.5\n*000190\r\n*9900VR\r\n"));
  ASSERT_EQ(seen.frames.size(), 6U);
  EXPECT_EQ(seen.skipped_bytes, 0U);
  const auto& [value, unit, command, negative, whole, all] =
      std::tie(seen.frames[0], seen.frames[1], seen.frames[2], seen.frames[3], seen.frames[4], seen.frames[5]);
  EXPECT_EQ(value.id, paroscientific::kValue);
  EXPECT_EQ(paroscientific::decode_value(value.bytes), 14.72317);
  EXPECT_EQ(paroscientific::address_of(value.bytes), (paroscientific::Address{0, 1}));
  EXPECT_EQ(unit.id, paroscientific::kUnits);
  EXPECT_EQ(paroscientific::parameter_of(unit.bytes), "1");
  EXPECT_EQ(command.id, paroscientific::kContinuous);
  EXPECT_EQ(paroscientific::address_of(command.bytes), (paroscientific::Address{1, 0}));
  EXPECT_EQ(paroscientific::parameter_of(command.bytes), "");
  EXPECT_EQ(paroscientific::decode_value(negative.bytes), -0.5);
  EXPECT_FALSE(paroscientific::decode_value(whole.bytes)) << "no pressure is sent without a point";
  EXPECT_EQ(paroscientific::address_of(all.bytes), (paroscientific::Address{99, 0}));
}

TEST(Paroscientific, WhatIsNoLine) {
  for (const std::string_view text :
       {"*0001\r\n", "*0001U\r\n", "*00x114.7\r\n", "*000114,7\r\n", "*0001un=1\r\n", "*0001UNIT\r\n",
        "*000114.7\rx", "*000112345678901234567890123456789012345678901234567890.5\r\n"}) {
    EXPECT_TRUE(all_at_once<paroscientific::Scanner>(bytes_of(text)).frames.empty()) << text;
  }
  EXPECT_EQ(all_at_once<paroscientific::Scanner>(bytes_of("*0001*000114.7\r\n")).frames.size(), 1U)
      << "a line that was cut is left for the next";
}

TEST(Paroscientific, UnitsOfTheManual) {
  EXPECT_NEAR(*paroscientific::unit_Pa(1) * 14.695949, 101325, 1);
  EXPECT_EQ(paroscientific::unit_Pa(2), 100);
  EXPECT_EQ(paroscientific::unit_Pa(3), 100000);
  EXPECT_EQ(paroscientific::unit_Pa(4), 1000);
  EXPECT_EQ(paroscientific::unit_Pa(5), 1000000);
  EXPECT_NEAR(*paroscientific::unit_Pa(6) * 29.92126, 101325, 1);
  EXPECT_NEAR(*paroscientific::unit_Pa(7) * 760, 101325, 1);
  EXPECT_EQ(paroscientific::unit_Pa(8), 9806.65);
  for (const int code : {-1, 0, 9}) EXPECT_FALSE(paroscientific::unit_Pa(code));
}

TEST(Keller, TheChecksumIsThatOfModbus) { EXPECT_EQ(crc16_modbus(bytes_of("123456789")), 0x4B37); }

TEST(Keller, TheChecksumOfEveryLengthIsThatOfBitByBit) {
  std::vector<std::uint8_t> bytes;
  for (unsigned length = 0; length < 40; ++length) {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
      crc ^= byte;
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
    }
    EXPECT_EQ(crc16_modbus(bytes), crc) << length;
    bytes.push_back(static_cast<std::uint8_t>(length * 151 + 7));
  }
}

// The checksums of the requests were calculated apart from the program.
TEST(Keller, RequestsAndAnswers) {
  EXPECT_EQ(keller::read_request(250, 1), (Buffer{0xFA, 0x49, 0x01, 0xA1, 0xA7}));
  EXPECT_EQ(keller::initialise_request(250), (Buffer{0xFA, 0x30, 0x04, 0x43}));
  const keller::Reading reading{1, 1.01325F, 0x02};
  EXPECT_TRUE(reading.failed(1));
  EXPECT_FALSE(reading.failed(0));
  EXPECT_EQ(keller::decode_reading(keller::encode(reading)), reading);
  const keller::Identity identity{1, 5, 20, 12, 10, 13, 1};
  EXPECT_EQ(keller::decode_identity(keller::encode(identity)), identity);
  const keller::Refusal refusal{7, keller::kReadChannel, keller::kNotInitialised};
  EXPECT_EQ(keller::decode_refusal(keller::encode(refusal)), refusal);
  EXPECT_EQ(keller::requested_channel(keller::read_request(3, 4)), 4);
  EXPECT_FALSE(keller::decode_reading(keller::encode(identity)));
  EXPECT_FALSE(keller::decode_identity(keller::read_request(3, 4)));
  EXPECT_FALSE(keller::requested_channel(keller::encode(reading)));
  const auto failed =
      keller::decode_reading(keller::encode(keller::Reading{1, std::numeric_limits<float>::quiet_NaN(), 0}));
  ASSERT_TRUE(failed);
  EXPECT_TRUE(std::isnan(failed->value));
}

TEST(Keller, AnEchoOfTheRequestIsNotTakenForTheAnswer) {
  Buffer stream = keller::read_request(250, 1);
  append(stream, keller::encode(keller::Reading{250, 0.98F, 0}));
  append(stream, keller::initialise_request(250));
  append(stream, keller::encode(keller::Identity{250, 5, 20, 12, 10, 13, 0}));
  const Outcome seen = all_at_once<keller::Scanner>(stream);
  ASSERT_EQ(seen.frames.size(), 4U);
  EXPECT_EQ(seen.frames[0].id, keller::kReadRequest);
  EXPECT_EQ(seen.frames[1].id, keller::kReading);
  EXPECT_EQ(seen.frames[2].id, keller::kInitialiseRequest);
  EXPECT_EQ(seen.frames[3].id, keller::kInitialised);
}

TEST(Keller, AVacuumIsAReading) {
  const Outcome seen = all_at_once<keller::Scanner>(keller::encode(keller::Reading{250, 0, 0}));
  ASSERT_EQ(seen.frames.size(), 1U);
  EXPECT_EQ(seen.frames[0].id, keller::kReading);
}

template <class S>
class PressureGauge : public testing::Test {};
using GaugeScanners = testing::Types<paroscientific::Scanner, keller::Scanner>;
TYPED_TEST_SUITE(PressureGauge, GaugeScanners);

TYPED_TEST(PressureGauge, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<TypeParam>(mixture(random, random_frame<TypeParam>, 40)));
  }
}

TYPED_TEST(PressureGauge, EveryCutGivesAPrefix) {
  Random random(4);
  Buffer stream;
  for (int i = 0; i < 8; ++i) append(stream, random_frame<TypeParam>(random));
  EXPECT_TRUE(every_cut_gives_a_prefix<TypeParam>(stream));
}

TEST(Keller, EveryFlippedBitOfAnAnswerShows) {
  // Bits of the function are left out: they make it another frame, whose length is another one.
  const Buffer frame = keller::encode(keller::Reading{250, 1.5F, 0});
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Buffer damaged = frame;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    for (const Seen& seen : all_at_once<keller::Scanner>(damaged).frames) EXPECT_NE(seen.offset, 0U) << bit;
  }
}

TEST(Paroscientific, WhatIsEncodedIsFoundByteForByte) {
  EXPECT_EQ(text_of(paroscientific::encode_line({1, 0}, "P4")), "*0100P4\r\n");
  EXPECT_EQ(text_of(paroscientific::encode_line({98, 76}, "14.7")), "*987614.7\r\n");
  const Outcome seen = all_at_once<paroscientific::Scanner>(paroscientific::encode_line({98, 76}, "14.7"));
  ASSERT_EQ(seen.frames.size(), 1U);
  EXPECT_EQ(paroscientific::address_of(seen.frames[0].bytes), (paroscientific::Address{98, 76}));
}

}  // namespace
}  // namespace navcal::protocols::test
