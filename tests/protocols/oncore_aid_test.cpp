// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "protocols/oncore_command.h"
#include "protocols/oncore_encode.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::test {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Fields and lengths as in the Motorola M12+ user's guide, @@Ga and @@Gb.
TEST(OncoreAid, HasTheBytesOfTheUsersGuide) {
  const std::vector<std::uint8_t> position{'@',  '@',  'G',  'a', 0, 0x36, 0xEE, 0x80, 0xFF,
                                           0xC9, 0x11, 0x80, 0,   0, 0x03, 0xE8, 0};
  const auto frame = oncore::encode_aid_position({1, -1, 10});
  ASSERT_EQ(frame.size(), 20U);
  EXPECT_TRUE(std::equal(position.begin(), position.end(), frame.begin()));
  const auto time = oncore::encode_aid_time(1'764'000'000 * kSecond_ns + 999'999'999);  // 2025-11-24 16:00:00
  ASSERT_EQ(time.size(), 17U);
  const std::vector<std::uint8_t> expected{'@', '@', 'G', 'b', 11, 24, 0x07, 0xE9, 16, 0, 0, 0, 0, 0};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), time.begin()));
}

TEST(OncoreAid, WhatIsEncodedIsUnderstood) {
  for (const double latitude : {-90.0, -37.25, 0.0, 89.5}) {
    for (const double longitude : {-180.0, -80.5, 0.0, 179.99}) {
      const auto position = oncore::parse_aid_position(oncore::encode_aid_position({latitude, longitude, -25.5}));
      ASSERT_TRUE(position);
      EXPECT_NEAR(position->latitude_deg, latitude, 1e-6);
      EXPECT_NEAR(position->longitude_deg, longitude, 1e-6);
      EXPECT_NEAR(position->height_m, -25.5, 0.01);
    }
  }
  for (const std::int64_t utc_s : {946'684'800LL, 1'709'164'799LL, 2'000'000'000LL})
    EXPECT_EQ(oncore::parse_aid_time(oncore::encode_aid_time(utc_s * kSecond_ns)), utc_s * kSecond_ns);
  EXPECT_EQ(oncore::parse_aid_position(oncore::encode_aid_position({95, 0, 0}))->latitude_deg, 90);
}

TEST(OncoreAid, WhatIsMalformedIsDroppedAndIsNoPoll) {
  const auto position = oncore::encode_aid_position({37, -80, 0});
  const auto time = oncore::encode_aid_time(1'764'000'000 * kSecond_ns);
  for (std::size_t i = 0; i < position.size(); ++i) {
    auto damaged = position;
    damaged[i] ^= 0x10;
    EXPECT_FALSE(oncore::parse_aid_position(damaged)) << i;
  }
  EXPECT_FALSE(oncore::parse_aid_position(time));
  EXPECT_FALSE(oncore::parse_aid_time(position));
  EXPECT_FALSE(oncore::parse_aid_time({}));
  EXPECT_FALSE(oncore::parse_command(position));
  EXPECT_FALSE(oncore::parse_command(time));
  // A query, whose fields are all FF.
  EXPECT_FALSE(oncore::parse_aid_position(oncore::encode_frame(oncore::kGa, std::vector<std::uint8_t>(13, 0xFF))));
  EXPECT_FALSE(oncore::parse_aid_time(oncore::encode_frame(oncore::kGb, std::vector<std::uint8_t>(10, 0xFF))));
}

TEST(OncoreAid, TheLastPlacesOfTheWorldAreTakenAndOneStepBeyondIsNot) {
  constexpr std::int32_t kQuarter_mas = 324'000'000, kHalf_mas = 648'000'000, kLeast_cm = -100'000,
                         kMost_cm = 1'800'000;
  const auto is_taken = [](std::int32_t latitude_mas, std::int32_t longitude_mas, std::int32_t height_cm) {
    std::vector<std::uint8_t> data;
    for (const std::int32_t value : {latitude_mas, longitude_mas, height_cm}) append_be(data, value);
    data.push_back(0);
    return oncore::parse_aid_position(oncore::encode_frame(oncore::kGa, data)).has_value();
  };
  for (const int sign : {-1, 1}) {
    EXPECT_TRUE(is_taken(sign * kQuarter_mas, 0, 0));
    EXPECT_FALSE(is_taken(sign * (kQuarter_mas + 1), 0, 0));
    EXPECT_TRUE(is_taken(0, sign * kHalf_mas, 0));
    EXPECT_FALSE(is_taken(0, sign * (kHalf_mas + 1), 0));
  }
  EXPECT_TRUE(is_taken(0, 0, kLeast_cm) && is_taken(0, 0, kMost_cm));
  EXPECT_FALSE(is_taken(0, 0, kLeast_cm - 1) || is_taken(0, 0, kMost_cm + 1));
}

}  // namespace
}  // namespace navcal::protocols::test
