// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_word.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/protocols/samples.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

using tcm2::decode_word;
using tcm2::Word;

std::optional<Word> decoded_word(std::string_view body) { return decode_word(bytes_of(line(body))); }

TEST(Tcm2Word, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const Word word = random_word(random);
    EXPECT_EQ(decode_word(tcm2::encode_word(word)), word);
  }
}

TEST(Tcm2Word, ExamplesOfTheManualByteForByte) {
  const Word full{328.3, 28.4, -12.4, 55.11, 12.33, -18.43, 22.3, 0x001};
  EXPECT_EQ(text_of(tcm2::encode_word(full)), "$C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001*29\r\n");
  EXPECT_EQ(decode_word(bytes_of("$C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001*29\r\n")), full);
  EXPECT_EQ(text_of(tcm2::encode_word({.heading = 328.3, .temperature = 22.3})), "$C328.3T22.3*2E\r\n");
  EXPECT_EQ(text_of(tcm2::encode_word({.heading = 326.3})), "$C326.3*69\r\n");
}

TEST(Tcm2Word, AnyFieldMayBeSwitchedOff) {
  constexpr std::array<std::string_view, 8> kFields{"C1.5",   "P-2.5", "R3.5", "X4.25",
                                                    "Y-5.25", "Z6.25", "T7.5", "E002"};
  for (unsigned on = 1; on < 256; ++on) {
    std::string body;
    for (unsigned i = 0; i < 8; ++i) {
      if ((on >> i & 1U) != 0) body += kFields[i];
    }
    const auto value = [on](unsigned i, double number) {
      return (on >> i & 1U) != 0 ? std::optional(number) : std::nullopt;
    };
    const Word expected{value(0, 1.5),   value(1, -2.5),
                        value(2, 3.5),   value(3, 4.25),
                        value(4, -5.25), value(5, 6.25),
                        value(6, 7.5),   (on >> 7 & 1U) != 0 ? std::optional<std::uint32_t>(2) : std::nullopt};
    EXPECT_EQ(decoded_word(body), expected) << body;
    EXPECT_EQ(expected.field().has_value(), (on & 0x38U) == 0x38U) << "the vector needs all three";
  }
}

TEST(Tcm2Word, ErrorCodeAfterANumberIsNoExponent) {
  const auto word = decoded_word("R12.8E002");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->roll, 12.8);
  EXPECT_EQ(word->error, 0x002U);
}

TEST(Tcm2Word, ErrorCodeIsHexadecimal) {
  EXPECT_EQ(decoded_word("C1.0E010")->error, 0x010U);
  EXPECT_EQ(decoded_word("C1.0E800")->error, 0x800U);
  EXPECT_EQ(decoded_word("C1.0E0C7")->error, 0x0C7U);
  EXPECT_EQ(decoded_word("C1.0E0c7")->error, 0x0C7U) << "case is not said by any source";
  EXPECT_FALSE(decoded_word("C1.0E")) << "no code";
  EXPECT_FALSE(decoded_word("C1.0E00G"));
}

TEST(Tcm2Word, StrayColonBeforeTheErrorIsPassedOver) {
  const auto word = decoded_word("C12.0T20.1:E200");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->error, 0x200U);
  EXPECT_EQ(word->temperature, 20.1);
  EXPECT_FALSE(decoded_word("C12.0:T20.1")) << "a colon elsewhere has no meaning";
}

TEST(Tcm2Word, OneOrTwoDecimalsOrNone) {
  EXPECT_EQ(decoded_word("C328.3")->heading, 328.3);
  EXPECT_EQ(decoded_word("C328.34")->heading, 328.34);
  EXPECT_EQ(decoded_word("C328")->heading, 328);
}

TEST(Tcm2Word, MilsPassAsTheyAre) {
  const auto word = decoded_word("C6399P-1600R1600");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->heading, 6399);
  EXPECT_EQ(word->pitch, -1600);
  EXPECT_EQ(text_of(tcm2::encode_word(*word, {.angles = 0})), line("C6399P-1600R1600"));
}

TEST(Tcm2Word, LargeFieldsAreNotOursToReject) {
  const auto word = decoded_word("X9999.99Y-9999.99Z0.00E004");
  ASSERT_TRUE(word && word->field());
  EXPECT_EQ((*word->field())[1], -9999.99);
}

TEST(Tcm2Word, WhatIsNoWord) {
  for (const std::string_view body :
       {"", "C", "C-", "C+1.0", "C1.0P", "C1.0P2.0C3.0", "P1.0C2.0", "C1.0e1", "Cnan", "Cinf", "C0x10", "C1,0",
        "C1.0 ", "C 1.0", "C--1", "C1.2.3", "Q1.0", "C1.0Q2.0", "E001C1.0"}) {
    EXPECT_FALSE(decoded_word(body)) << body;
  }
  EXPECT_FALSE(decode_word({}));
}

TEST(Tcm2Word, NoMinusBeforeZero) {
  EXPECT_EQ(text_of(tcm2::encode_word({.pitch = -0.04, .x = -0.001})), line("P0.0X0.00"));
}

TEST(Tcm2Hchdm, IsTheHeadingAsNmea) {
  EXPECT_EQ(tcm2::decode_hchdm(bytes_of("$HCHDM,182.3,M*21\r\n")), 182.3);
  EXPECT_EQ(text_of(tcm2::encode_hchdm(182.3)), "$HCHDM,182.3,M*21\r\n");
  for (const std::string_view body :
       {"HCHDM,,M", "HCHDM,M", "HCHDM,12.3,T", "HCHDM,12.3", "HCHDM,x,M", "HCHDM,1.5,2,M"}) {
    EXPECT_FALSE(tcm2::decode_hchdm(bytes_of(line(body)))) << body;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
