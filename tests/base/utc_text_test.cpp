// SPDX-License-Identifier: Apache-2.0
#include "base/utc_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/durations.h"

namespace navcal::base {
namespace {

constexpr std::int64_t kDay_ns = 86'400 * kSecond_ns;

TEST(UtcText, HasDateTimeAndMilliseconds) {
  EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(utc_text(1'764'000'000'123'456'789), "2025-11-24T16:00:00.123Z");
  EXPECT_EQ(utc_date_text(1'764'000'000'123'456'789), "2025-11-24");
}

TEST(UtcText, KnowsLeapDaysAndNewYear) {
  EXPECT_EQ(utc_date_text(951'782'400 * kSecond_ns), "2000-02-29");
  EXPECT_EQ(utc_date_text(1'709'164'800 * kSecond_ns), "2024-02-29");
  EXPECT_EQ(utc_text(1'893'456'000 * kSecond_ns - 1), "2029-12-31T23:59:59.999Z");
  EXPECT_EQ(utc_text(1'893'456'000 * kSecond_ns), "2030-01-01T00:00:00.000Z");
}

TEST(UtcText, OfTimesBefore1970BelongsToTheDayInWhichTheyLie) {
  EXPECT_EQ(utc_text(-1), "1969-12-31T23:59:59.999Z");
  EXPECT_EQ(utc_date_text(-kDay_ns), "1969-12-31");
  EXPECT_EQ(utc_date_text(-kDay_ns - 1), "1969-12-30");
}

TEST(UtcText, BearsTheLargestAndSmallestTime) {
  EXPECT_EQ(utc_text(std::numeric_limits<std::int64_t>::max()), "2262-04-11T23:47:16.854Z");
  EXPECT_EQ(utc_text(std::numeric_limits<std::int64_t>::min()), "1677-09-21T00:12:43.145Z");
}

}  // namespace
}  // namespace navcal::base
