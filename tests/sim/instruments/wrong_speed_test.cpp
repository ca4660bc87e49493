// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/wrong_speed.h"

#include <gtest/gtest.h>

#include "protocols/tcm2.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

constexpr std::string_view kWord = "$C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001*29\r\n";

std::string heard(int sent_baud, int heard_baud) {
  const auto bytes = heard_at(bytes_of(kWord), sent_baud, heard_baud);
  return {bytes.begin(), bytes.end()};
}

TEST(WrongSpeed, TheRightOneAndSmallErrorsChangeNothing) {
  EXPECT_EQ(heard(9600, 9600), kWord);
  EXPECT_EQ(heard(9600, 9700), kWord) << "1 %";
  EXPECT_EQ(heard(9600, 9500), kWord);
}

TEST(WrongSpeed, AnyOtherIsGarbageOfAboutTheRightLength) {
  for (const auto& [sent, set] :
       {std::pair{38400, 9600}, std::pair{9600, 38400}, std::pair{9600, 4800}, std::pair{19200, 57600}}) {
    const std::string garbage = heard(sent, set);
    ASSERT_FALSE(garbage.empty());
    EXPECT_LE(garbage.size(), kWord.size() * static_cast<std::size_t>(std::max(1, set / sent)) + 1);
    protocols::tcm2::Parser parser;
    std::uint64_t words = 0;
    parser.feed(bytes_of(garbage),
                [&](const protocols::Frame& frame) { words += frame.id == protocols::tcm2::kWord ? 1 : 0; });
    EXPECT_EQ(words, 0U) << sent << " heard at " << set;
  }
}

TEST(WrongSpeed, AByteAtTwiceTheSpeedOfTheReceiver) {
  // On the wire, in bits of the sender: 0 1111 0000 1; the receiver samples at 3, 5, 7, 9, ... of them, then idle.
  EXPECT_EQ(heard_at(std::vector<std::uint8_t>{0x0F}, 9600, 4800), (std::vector<std::uint8_t>{0xF9}));
}

}  // namespace
}  // namespace navcal::sim::testing
