// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/gravity.h"
#include "protocols/described/reading.h"
#include "protocols/described/text.h"
#include "tests/protocols/described_samples.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::described::test {
namespace {

using protocols::test::bytes_of;

std::vector<double> plain_values(const Description& device, Bytes frame, std::size_t kind = 0) {
  std::vector<double> values(device.kinds.at(kind).fields.size());
  FrameReader(device.kinds.at(kind), device.is_text).read_plain(frame, values);
  return values;
}

std::vector<double> sample_values(const FrameKind& kind, bool is_text, Bytes frame, bool& possible) {
  std::vector<double> values(kind.fields.size());
  possible = FrameReader(kind, is_text).read(frame, values);
  return values;
}

TEST(DescribedSums, CheckValues) {
  const auto of = [](Sum sum) { return sum_of(sum, bytes_of("123456789")); };
  EXPECT_EQ(of(Sum::none), 0U);
  EXPECT_EQ(of(Sum::sum8), 0xDDU);
  EXPECT_EQ(of(Sum::negated_sum8), 0x23U);
  EXPECT_EQ(of(Sum::sum16), 0x01DDU);
  EXPECT_EQ(of(Sum::xor8), 0x31U);
  EXPECT_EQ(of(Sum::crc8), 0xF4U);
  EXPECT_EQ(of(Sum::crc16_ccitt), 0x29B1U);
  EXPECT_EQ(of(Sum::crc16_xmodem), 0x31C3U);
  EXPECT_EQ(of(Sum::crc16_modbus), 0x4B37U);
  EXPECT_EQ(of(Sum::crc32), 0xCBF43926U);
  EXPECT_EQ(sum_of(Sum::fletcher16, bytes_of("abcde")), 0xEFC3U);  // 8-bit Fletcher modulo 256 of RFC 1145
}

TEST(DescribedSums, NamesAreReadBack) {
  for (std::size_t i = 0; i < kSumCount; ++i) {
    const auto sum = static_cast<Sum>(i);
    EXPECT_EQ(sum_named(name_of(sum)), sum);
  }
  EXPECT_FALSE(sum_named("crc17"));
}

TEST(DescribedUnits, AreThoseOfTheProgram) {
  EXPECT_EQ(unit_named("deg/s")->factor, base::kRadiansPerDegree);
  EXPECT_EQ(unit_named("deg")->factor, base::kRadiansPerDegree);
  EXPECT_EQ(unit_named("g")->factor, base::kGravity_m_s2);
  EXPECT_NEAR(212 * unit_named("F")->factor + unit_named("F")->offset, 100, 1e-12);
  EXPECT_EQ(unit_named("furlong"), nullptr);
}

TEST(DescribedUnits, EachMeaningHasAUnitOfSamples) {
  for (std::size_t i = 0; i < kMeaningCount; ++i) {
    const auto meaning = static_cast<Meaning>(i);
    const MeaningInfo& info = info_of(meaning);
    EXPECT_EQ(meaning_named(info.name), meaning);
    EXPECT_LT(info.low, info.high) << info.name;
    if (info.dimension == Dimension::any || info.dimension == Dimension::number) continue;
    const auto units = all_units();  // the first of a dimension is that of samples
    const auto unit =
        std::find_if(units.begin(), units.end(), [&](const Unit& one) { return one.dimension == info.dimension; });
    ASSERT_NE(unit, units.end()) << info.name;
    EXPECT_EQ(unit->factor, 1) << info.name;
  }
}

TEST(DescribedReading, WhatIsEncodedIsRead) {
  Random random(1);
  for (const NamedDevice& device : all_devices()) {
    for (int i = 0; i < 200; ++i) {
      const std::size_t at = below(random, device.description.kinds.size());
      const FrameKind& kind = device.description.kinds[at];
      const auto values = random_values(random, kind);
      EXPECT_EQ(plain_values(device.description, encode(device.description, kind, values), at), values)
          << device.name;
    }
  }
}

TEST(DescribedReading, ScalesBeforeItTakesTheZeroAndTheUnitComesLast) {
  Description device = inertial_card();
  Field& field = device.kinds[0].fields[2];
  field.scale = 0.0625;
  field.zero = 2048;
  field.sensitivity = 10;
  field.factor = base::kRadiansPerDegree;
  field.meaning = Meaning::rate_x;
  std::vector<double> raw(10, 0.0);
  raw[2] = (33333 / 16.0 - 2048) / 10;
  const Buffer frame = encode(device, device.kinds[0], raw);
  bool possible = false;
  EXPECT_EQ(sample_values(device.kinds[0], false, frame, possible)[2], raw[2] * base::kRadiansPerDegree);
  EXPECT_TRUE(possible);
}

TEST(DescribedReading, SignedNumbersAndBits) {
  const Description device = two_kinds();
  const std::vector<double> values{-1.5, -8388608, 127};
  EXPECT_EQ(plain_values(device, encode(device, device.kinds[0], values)), values);
}

TEST(DescribedReading, NumbersThatAreNoneAreAbsent) {
  Description device = two_kinds();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Buffer frame = encode(device, device.kinds[0], std::vector<double>{0, 0, 0});
  for (std::size_t i = 2; i < 6; ++i) frame[i] = 0xFF;  // NaN as f32
  EXPECT_TRUE(std::isnan(plain_values(device, frame)[0]));
  device.kinds[0].fields[1].absent = -32768;
  frame = encode(device, device.kinds[0], std::vector<double>{1, nan, 3});
  bool possible = false;
  EXPECT_TRUE(std::isnan(sample_values(device.kinds[0], false, frame, possible)[1]));
  EXPECT_TRUE(possible);
}

TEST(DescribedReading, NoValueLeavesWhatADoubleHolds) {
  FrameKind kind = bare_lines().kinds[0];
  kind.fields[0].scale = 1e15;
  bool possible = true;
  (void)sample_values(kind, true, bytes_of("1e300,1,1\n"), possible);
  EXPECT_FALSE(possible);
  Description device = two_kinds();
  device.kinds[1].fields[1].scale = 1e-15;
  const Buffer frame = encode(device, device.kinds[1], std::vector<double>{0, 1e280});
  EXPECT_TRUE(std::isnan(plain_values(device, frame, 1)[1]));
}

TEST(DescribedReading, AFieldBeyondAShorterFrameIsAbsent) {
  Description device = two_kinds();
  FrameKind shorter = device.kinds[1];
  shorter.fields.pop_back();
  const auto values = plain_values(device, encode(device, shorter, std::vector<double>{7}), 1);
  EXPECT_EQ(values[0], 7);
  EXPECT_TRUE(std::isnan(values[1]));
}

TEST(DescribedReading, RefusesWhatCannotBe) {
  Description device = inertial_card();
  Field& field = device.kinds[0].fields[2];
  std::vector<double> raw(10, 0.0);
  raw[2] = 4000;
  const Buffer frame = encode(device, device.kinds[0], raw);
  bool possible = false;
  (void)sample_values(device.kinds[0], false, frame, possible);
  EXPECT_TRUE(possible);
  field.high = 3999;
  (void)sample_values(device.kinds[0], false, frame, possible);
  EXPECT_FALSE(possible);
  field.high.reset();
  field.meaning = Meaning::rate_x;  // 4000 rad/s
  (void)sample_values(device.kinds[0], false, frame, possible);
  EXPECT_FALSE(possible);
}

TEST(DescribedReading, TextThatIsNoNumberIsRefusedAndNothingIsAbsent) {
  const FrameKind kind = bare_lines().kinds[0];
  bool possible = false;
  auto values = sample_values(kind, true, bytes_of("1.5, ,-2e1\r\n"), possible);
  EXPECT_TRUE(possible);
  EXPECT_EQ(values[0], 1.5);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], -20);
  (void)sample_values(kind, true, bytes_of("1.5,x,3\n"), possible);
  EXPECT_FALSE(possible);
  (void)sample_values(kind, true, bytes_of("nan,1,3\n"), possible);
  EXPECT_FALSE(possible);
}

TEST(DescribedReading, DegreesAndMinutesWithTheirSign) {
  FrameKind kind = bare_lines().kinds[0];
  kind.fields.resize(1);
  kind.fields[0].type = Type::degrees_minutes;
  kind.fields[0].sign_at = 2;
  bool possible = false;
  EXPECT_NEAR(sample_values(kind, true, bytes_of("4807.0380,S,\n"), possible)[0], -48.1173, 1e-12);
  EXPECT_TRUE(possible);
  (void)sample_values(kind, true, bytes_of("4807.0380,X,\n"), possible);
  EXPECT_FALSE(possible);
  (void)sample_values(kind, true, bytes_of("4867.0,S,\n"), possible);
  EXPECT_FALSE(possible);
}

TEST(DescribedReading, NmeaHasNeitherBlanksNorExponents) {
  EXPECT_EQ(number_of("+2.50", Type::nmea), 2.5);
  EXPECT_FALSE(number_of("2.5 ", Type::nmea));
  EXPECT_FALSE(number_of("1e3", Type::nmea));
  EXPECT_EQ(number_of(" 2.5 ", Type::decimal), 2.5);
  EXPECT_EQ(number_of("1e3", Type::decimal), 1000);
}

TEST(DescribedReading, Hexadecimal) {
  EXPECT_EQ(number_of("ff", Type::hex), 255);
  EXPECT_EQ(number_of("0xFF", Type::hex), 255);
  EXPECT_EQ(number_of("-1", Type::hex), -1);
  EXPECT_FALSE(number_of("fg", Type::hex));
}

TEST(DescribedReading, EveryTypeInBothOrdersHoldsItsExtremes) {
  const std::vector<std::pair<Type, std::vector<double>>> types{{Type::u8, {0, 255}},
                                                                {Type::i8, {-128, 127}},
                                                                {Type::u16, {0, 65535, 258}},
                                                                {Type::i16, {-32768, 32767, 258}},
                                                                {Type::u24, {0, 16777215, 66051}},
                                                                {Type::i24, {-8388608, 8388607, 66051}},
                                                                {Type::u32, {0, 4294967295.0, 16909060}},
                                                                {Type::i32, {-2147483648.0, 2147483647, 16909060}},
                                                                {Type::f32, {-1.5, 0.25, 3e38F}},
                                                                {Type::f64, {-1.5, 0.1, 1e200}}};
  for (const auto& [type, values] : types) {
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
      Description device = inertial_card();
      FrameKind& kind = device.kinds[0];
      kind.fields = {number_field("x", type, 4, order)};
      for (const double value : values) {
        EXPECT_EQ(plain_values(device, encode(device, kind, std::vector<double>{value}))[0], value)
            << static_cast<int>(type);
      }
    }
  }
}

TEST(DescribedReading, BitsWithinANumber) {
  Description device = inertial_card();
  FrameKind& kind = device.kinds[0];
  for (const Type type : {Type::u8, Type::u16, Type::u24, Type::u32}) {
    Field low = number_field("low", type, 4, ByteOrder::big), high = low;
    low.bits = 3;
    high.first_bit = 3;
    high.bits = 5;
    kind.fields = {low, high};
    const std::vector<double> values{5, 27};
    EXPECT_EQ(plain_values(device, encode(device, kind, values)), values) << static_cast<int>(type);
  }
}

TEST(DescribedReading, EverySignThatAFieldMayState) {
  FrameKind kind = bare_lines().kinds[0];
  kind.fields.resize(1);
  kind.fields[0].sign_at = 2;
  const auto read_with = [&](const std::string& sign) {
    bool possible = false;
    const auto values = sample_values(kind, true, bytes_of("12.5," + sign + ",0\n"), possible);
    return possible ? std::optional(values[0]) : std::nullopt;
  };
  for (const char* const sign : {"N", "E", "+", "", " N "}) EXPECT_EQ(read_with(sign), 12.5) << sign;
  for (const char* const sign : {"S", "W", "-", " S"}) EXPECT_EQ(read_with(sign), -12.5) << sign;
  for (const char* const sign : {"n", "NE", "0", "--"}) EXPECT_FALSE(read_with(sign)) << sign;
}

TEST(DescribedReading, AFieldWithAKeyIsFoundWhereverItStands) {
  const FrameKind kind = keyed_lines().kinds[0];
  const auto read_line = [&](const std::string& body) {
    std::vector<double> values(kind.fields.size());
    FrameReader(kind, true).read_plain(bytes_of("#" + body + "!0000;"), values);
    return values;
  };
  const std::string sign(1, kind.key_sign);
  EXPECT_EQ(read_line("T" + sign + "1.5 H" + sign + "ff"), (std::vector<double>{1.5, 255}));
  EXPECT_EQ(read_line("H" + sign + "ff  X" + sign + "3 T" + sign + "1.5"), (std::vector<double>{1.5, 255}));
  const auto without = read_line("TX" + sign + "1.5 H" + sign + "10");
  EXPECT_TRUE(std::isnan(without[0])) << "a longer key is another one";
  EXPECT_EQ(without[1], 16);
}

TEST(DescribedReading, LimitsOfTheFieldAndOfTheMeaningBelongToTheRange) {
  FrameKind kind = bare_lines().kinds[0];
  kind.fields.resize(1);
  const auto is_possible = [&](double value) {
    bool possible = false;
    (void)sample_values(kind, true, bytes_of(std::to_string(value) + ",0,0\n"), possible);
    return possible;
  };
  kind.fields[0].low = -2;
  kind.fields[0].high = 3;
  EXPECT_TRUE(is_possible(-2) && is_possible(3));
  EXPECT_FALSE(is_possible(-2.001) || is_possible(3.001));
  kind.fields[0].low.reset();
  kind.fields[0].high.reset();
  kind.fields[0].meaning = Meaning::pressure;
  EXPECT_TRUE(is_possible(0) && is_possible(1e5));
  EXPECT_FALSE(is_possible(-0.001)) << "below a vacuum";
}

TEST(DescribedUnits, AngularAndVectorMeaningsHaveRoomOnBothSides) {
  for (std::size_t i = 0; i < kMeaningCount; ++i) {
    const MeaningInfo& info = info_of(static_cast<Meaning>(i));
    const bool is_vector = info.name.ends_with(".x") || info.name.ends_with(".y") || info.name.ends_with(".z");
    if (is_vector || info.dimension == Dimension::angle) {
      EXPECT_EQ(info.low, -info.high) << info.name;
    }
  }
  const auto holds = [](Meaning meaning, double turns) {
    const MeaningInfo& info = info_of(meaning);
    return info.low <= 2 * std::numbers::pi * turns && 2 * std::numbers::pi * turns <= info.high;
  };
  EXPECT_TRUE(holds(Meaning::heading, 1) && holds(Meaning::pitch, 1) && holds(Meaning::roll, 1))
      << "of any branch";
  EXPECT_FALSE(holds(Meaning::heading, 2.1) || holds(Meaning::pitch, 1.1) || holds(Meaning::roll, 1.1));
}

TEST(DescribedReading, MinutesBesideTheEquatorAndTheMeridian) {
  EXPECT_NEAR(number_of("0000.5000", Type::degrees_minutes).value_or(9), 0.5 / 60, 1e-12);
  EXPECT_EQ(number_of("0000.0000", Type::degrees_minutes), 0);
  EXPECT_NEAR(number_of("17959.9999", Type::degrees_minutes).value_or(0), 180 - 1e-4 / 60, 1e-9);
  for (const char* text : {"-0000.5", "0060.0", "0099.9", "", "x"})
    EXPECT_FALSE(number_of(text, Type::degrees_minutes)) << text;
}

}  // namespace
}  // namespace navcal::protocols::described::test
