// SPDX-License-Identifier: Apache-2.0
#include "web/message_fields.h"

#include <gtest/gtest.h>

namespace navcal::web {
namespace {

constexpr std::string_view kNav =
    R"({"class":"NAV","time":12.500000000,"device":"navigation","lat":-59.25,"lon":null,"fix":"2d","n":7})";

TEST(MessageFields, TextIsWithoutItsQuotes) {
  EXPECT_EQ(member_text(kNav, "device"), "navigation");
  EXPECT_EQ(member_text(kNav, "time"), "12.500000000");
  EXPECT_EQ(member_text(kNav, "lon"), "null");
  EXPECT_EQ(member_text(kNav, "absent"), "");
}

TEST(MessageFields, NumbersOnlyOfNumbers) {
  EXPECT_EQ(member_number(kNav, "lat"), -59.25);
  EXPECT_EQ(member_number(kNav, "n"), 7);
  EXPECT_FALSE(member_number(kNav, "lon"));
  EXPECT_FALSE(member_number(kNav, "fix"));
  EXPECT_FALSE(member_number(kNav, "absent"));
}

TEST(MessageFields, AKeyWithinATextIsNoKey) {
  constexpr std::string_view kEvent = R"({"message":"say \"lat\":5, quietly","lat":3,"flat":9})";
  EXPECT_EQ(member_number(kEvent, "lat"), 3);
  EXPECT_EQ(member_text(kEvent, "message"), R"(say \"lat\":5, quietly)");
}

TEST(MessageFields, CutTextsAreHarmless) {
  for (std::size_t n = 0; n <= kNav.size(); ++n) {
    const std::string_view cut = kNav.substr(0, n);
    EXPECT_LE(member_text(cut, "fix").size(), n);
    EXPECT_EQ(member_number(cut, "lat").has_value(), cut.find("lat\":-5") != std::string_view::npos);
  }
  EXPECT_EQ(member_text(R"({"a":"no end)", "a"), "");
  EXPECT_EQ(member_text(R"({"a":)", "a"), "");
}

}  // namespace
}  // namespace navcal::web
