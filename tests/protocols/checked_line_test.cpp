// SPDX-License-Identifier: Apache-2.0
#include "protocols/checked_line.h"

#include <gtest/gtest.h>

#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

constexpr FrameId kId{"LINE"};

Scan scan(std::string_view text, std::size_t max_length = 64) {
  const Bytes bytes = bytes_of(text);
  return scan_checked_line(bytes.data(), bytes.data() + bytes.size(), max_length, kId);
}

TEST(CheckedLine, TheBodyEndsWhereByteByByteItEnds) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    Buffer bytes(below(random, 40));
    for (auto& byte : bytes) {
      // Bytes around the limits, and high ones, whose borrows could mislead a comparison of eight at once.
      constexpr std::uint8_t kTricky[] = {0x20, 0x1F, 0x21, 0x23, 0x25, 0x29, 0x2B,
                                          0x7F, 0x80, 0xA0, 0xA4, 0xAA, 0xFF};
      byte = below(random, 20) == 0 ? static_cast<std::uint8_t>(random())
                                    : kTricky[below(random, std::size(kTricky))];
    }
    std::size_t expected_end = 0;
    std::uint8_t expected_sum = 0;
    while (expected_end < bytes.size() && !detail::ends_body(bytes[expected_end]))
      expected_sum ^= bytes[expected_end++];
    std::uint8_t sum = 0;
    const std::uint8_t* const end = detail::pass_body(bytes.data(), bytes.data() + bytes.size(), sum);
    ASSERT_EQ(end - bytes.data(), static_cast<std::ptrdiff_t>(expected_end));
    ASSERT_EQ(sum, expected_sum);
  }
}

TEST(CheckedLine, WhatIsMadeIsFound) {
  for (std::size_t length = 0; length < 40; ++length) {
    const std::string text = line(std::string(length, 'x'));
    const Scan found = scan(text);
    EXPECT_EQ(found.kind, Scan::Kind::frame);
    EXPECT_EQ(found.length, text.size());
    EXPECT_EQ(found.id, kId);
    EXPECT_EQ(body_of(bytes_of(text)), std::string(length, 'x'));
  }
}

TEST(CheckedLine, EveryPrefixIsIncompleteAndAsksForNoMoreThanIsMissing) {
  const std::string text = line("abcdefghijk");
  for (std::size_t length = 1; length < text.size(); ++length) {
    const Scan found = scan(text.substr(0, length));
    EXPECT_EQ(found.kind, Scan::Kind::incomplete) << length;
    EXPECT_LE(found.length, text.size() - length);
  }
}

TEST(CheckedLine, WhatALineMayNotHold) {
  EXPECT_EQ(scan("$abc$").kind, Scan::Kind::not_a_frame) << "the next line begins";
  EXPECT_EQ(scan("$abc\r").kind, Scan::Kind::bad_checksum) << "no checksum";
  EXPECT_EQ(scan("$a\x01").kind, Scan::Kind::bad_checksum);
  EXPECT_EQ(scan("$a*7").kind, Scan::Kind::bad_checksum) << "decided at the first digit";
  EXPECT_EQ(scan("$a*61x").kind, Scan::Kind::bad_checksum);
  EXPECT_EQ(scan("$a*61\rx").kind, Scan::Kind::bad_checksum);
  EXPECT_EQ(scan("$a*61\n").length, 6U) << "LF alone";
}

TEST(CheckedLine, SeveralCarriageReturnsAndBlanksMayStandBeforeTheEnd) {
  for (const std::string end : {"\r\r\n", "  \r\n", "\r\r\r\n", " \n"}) {
    const std::string text = "$a*61" + end;
    EXPECT_EQ(scan(text).kind, Scan::Kind::frame);
    EXPECT_EQ(scan(text).length, text.size());
    for (std::size_t length = 1; length < text.size(); ++length) {
      EXPECT_EQ(scan(text.substr(0, length)).kind, Scan::Kind::incomplete) << length;
      EXPECT_LE(scan(text.substr(0, length)).length, text.size() - length);
    }
  }
  EXPECT_EQ(scan("$a*61\r\r$").kind, Scan::Kind::bad_checksum);
  EXPECT_EQ(scan("$a*61" + std::string(70, '\r')).kind, Scan::Kind::not_a_frame) << "no end within the maximum";
}

TEST(CheckedLine, NoLineIsLongerThanTheMaximum) {
  const std::string text = line(std::string(20, 'x'));
  EXPECT_EQ(scan(text, text.size()).kind, Scan::Kind::frame);
  EXPECT_EQ(scan(text, text.size() - 1).kind, Scan::Kind::not_a_frame);
  EXPECT_EQ(scan(text.substr(0, text.size() - 2), text.size() - 1).length, 1U)
      << "one byte decides that it is too long";
}

}  // namespace
}  // namespace navcal::protocols::test
