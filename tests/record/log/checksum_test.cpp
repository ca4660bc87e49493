// SPDX-License-Identifier: Apache-2.0
#include "record/log/checksum.h"

#include <gtest/gtest.h>

namespace navcal::record {
namespace {

TEST(Checksum, CheckValuesOfTheCatalogue) {
  EXPECT_EQ(crc32c("123456789"), 0xE3069283U);
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
  EXPECT_EQ(crc32c(""), 0U);
}

TEST(Checksum, ASumCanBeContinued) {
  for (std::size_t cut = 0; cut <= 9; ++cut) {
    const std::string_view text = "123456789";
    EXPECT_EQ(crc32(text.substr(cut), crc32(text.substr(0, cut))), 0xCBF43926U) << cut;
    EXPECT_EQ(crc32c(text.substr(cut), crc32c(text.substr(0, cut))), 0xE3069283U) << cut;
  }
}

TEST(Checksum, AJsonMessageMustEndInItsSum) {
  EXPECT_TRUE(json_crc_holds("{\"a\":1,\"crc\":\"c76f6aa8\"}") == (crc32c("{\"a\":1") == 0xc76f6aa8U));
  EXPECT_FALSE(json_crc_holds(""));
  EXPECT_FALSE(json_crc_holds("{\"a\":1}"));
  EXPECT_FALSE(json_crc_holds(",\"crc\":\"00000000\"}"));
}

}  // namespace
}  // namespace navcal::record
