// SPDX-License-Identifier: Apache-2.0
#include "protocols/decimal.h"

#include <gtest/gtest.h>

#include <clocale>
#include <iostream>

namespace navcal::protocols {
namespace {

TEST(Decimal, TakesTheNumberAndLeavesTheRest) {
  std::string_view text = "-12.8E002";
  EXPECT_EQ(take_decimal(text), -12.8);
  EXPECT_EQ(text, "E002");
}

TEST(Decimal, LeavesTheTextWhereThereIsNone) {
  for (const std::string_view original : {"", "-", ".", "-.", "+1", "x1", " 1", "nan", "inf", "-inf", "--1"}) {
    std::string_view text = original;
    EXPECT_FALSE(take_decimal(text)) << original;
    EXPECT_EQ(text, original);
  }
}

TEST(Decimal, TheWholeTextOrNothing) {
  EXPECT_EQ(decimal("0.5"), 0.5);
  EXPECT_EQ(decimal(".5"), 0.5);
  for (const std::string_view text : {"", "0.5x", "1e1", "1,5", "0x1"}) EXPECT_FALSE(decimal(text)) << text;
}

TEST(Decimal, TheLocaleChangesNothing) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
    std::cout << "no locale with a decimal comma is installed: checked under " << before << '\n';
  }
  EXPECT_EQ(decimal("1.5"), 1.5);
  EXPECT_FALSE(decimal("1,5"));
  std::string text;
  append_decimal(text, 1.5, 1);
  EXPECT_EQ(text, "1.5");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Decimal, IntegersThatFit) {
  EXPECT_EQ(integer<std::uint8_t>("255"), 255);
  EXPECT_EQ(integer<std::int32_t>("-7"), -7);
  EXPECT_EQ(integer<std::uint32_t>("0C7", 16), 0x0C7U);
  for (const std::string_view text : {"", "256", "-1", "+1", "1.0", "1 "})
    EXPECT_FALSE(integer<std::uint8_t>(text)) << text;
}

TEST(Decimal, PrintsAsInstrumentsDo) {
  const auto printed = [](double value, int decimals) {
    std::string text;
    append_decimal(text, value, decimals);
    return text;
  };
  EXPECT_EQ(printed(-12.36, 1), "-12.4");
  EXPECT_EQ(printed(-0.04, 1), "0.0");
  EXPECT_EQ(printed(-0.4, 0), "0");
  EXPECT_EQ(printed(6399, 0), "6399");
  EXPECT_EQ(printed(-99999999999999, 6), "-99999999999999.000000");
}

TEST(Decimal, HexadecimalFilledUp) {
  std::string text;
  append_hex(text, 0x1, 3);
  append_hex(text, 0xABCDE, 3);
  EXPECT_EQ(text, "001ABCDE");
}

}  // namespace
}  // namespace navcal::protocols
