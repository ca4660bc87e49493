// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_reply.h"

#include <gtest/gtest.h>

#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

using tcm2::decode_reply;
using tcm2::encode_reply;
using tcm2::Reply;

std::optional<Reply> decoded(std::string_view text) { return decode_reply(bytes_of(text)); }

TEST(Tcm2Reply, Accepted) {
  EXPECT_EQ(decoded(":\r\n"), Reply{});
  EXPECT_EQ(text_of(encode_reply({})), ":\r\n");
}

TEST(Tcm2Reply, RefusedWithAHexadecimalCode) {
  const Reply refused{Reply::Kind::refused, 0x040, {}, {}, {}};
  EXPECT_EQ(decoded(":E040\r\n"), refused);
  EXPECT_EQ(text_of(encode_reply(refused)), ":E040\r\n");
  EXPECT_EQ(decoded(":E01A\r\n")->error, 0x01AU);
  EXPECT_FALSE(decoded(":E\r\n"));
  EXPECT_FALSE(decoded(":E04X\r\n"));
}

TEST(Tcm2Reply, ParameterAndValue) {
  constexpr std::string_view kText = ":clock=40\r\n";
  const auto reply = decoded(kText);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->kind, Reply::Kind::value);
  EXPECT_EQ(reply->parameter, "clock");
  EXPECT_EQ(reply->value, "40");
  EXPECT_EQ(text_of(encode_reply(*reply)), kText);
  for (const std::string_view text : {":clock=\r\n", ":=40\r\n", ":CLOCK=40\r\n", ":clock\r\n"}) {
    EXPECT_FALSE(decoded(text)) << text;
  }
}

TEST(Tcm2Reply, CalibrationScoreWithAndWithoutColon) {
  const Reply score{Reply::Kind::calibration, 0, {}, {}, {9, 7, 14.5}};
  EXPECT_EQ(decoded("H9V7M14.5\r\n"), score);
  EXPECT_EQ(decoded(":H9V7M14.5\r\n"), score);
  EXPECT_EQ(text_of(encode_reply({Reply::Kind::calibration, 0, {}, {}, {}})), "H0V0M0.00\r\n");
  for (const std::string_view text :
       {"H9V7\r\n", "H9V7M\r\n", "H-1V0M0\r\n", "H10V0M0\r\n", "H1V2M3X\r\n", "HV1M2\r\n"}) {
    EXPECT_FALSE(decoded(text)) << text;
  }
}

TEST(Tcm2Reply, NothingElseIsAReply) {
  for (const std::string_view text : {"", "\r\n", "go\r\n", "E010\r\n", "clock=40\r\n", ":$C1.0*00\r\n"}) {
    EXPECT_FALSE(decoded(text)) << text;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
