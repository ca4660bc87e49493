// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace navcal::base {
namespace {

TEST(Printable, TextStaysAsItIs) {
  for (const char* text :
       {"", "dive 3 begins: \"EIO\" \\", "Tauchgang \xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x90\xA0"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, OfAFileErrorOnlyFileAndReasonAreTold) {
  EXPECT_EQ(printable(std::runtime_error("a\x1b")), "a\\u001b");
  const std::filesystem::filesystem_error error("cannot create directories", "/proc/x",
                                                std::make_error_code(std::errc::no_such_file_or_directory));
  EXPECT_EQ(printable(error), "/proc/x: No such file or directory");
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("a\x1b]0;x\x07"), "a\\u001b]0;x\\u0007");
  EXPECT_EQ(printable("one\r\ntwo\t"), "one\\u000d\\u000atwo\\u0009");
  EXPECT_EQ(printable("one\ntwo\x7F", "\n"), "one\ntwo\\u007f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u00c2\\u009b31m")
      << "a control character of two bytes";
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\u0000");
}

TEST(Printable, WhatIsNotUtf8IsEscaped) {
  EXPECT_EQ(printable("\x9B"
                      "2J"),
            "\\u009b2J");
  EXPECT_EQ(printable("\xC3"), "\\u00c3");
  EXPECT_EQ(printable("\xE0\x80\x9B"), "\\u00e0\\u0080\\u009b") << "a longer form of a control character";
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string shown = printable(std::string{static_cast<char>(first), static_cast<char>(second)});
      EXPECT_TRUE(
          std::none_of(shown.begin(), shown.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }));
    }
  }
}

}  // namespace
}  // namespace navcal::base
