// SPDX-License-Identifier: Apache-2.0
#include "protocols/utc.h"

#include <gtest/gtest.h>

namespace navcal::protocols {
namespace {

TEST(Utc, KnowsTheCalendar) {
  EXPECT_TRUE(is_valid(Date{2024, 2, 29}));
  EXPECT_FALSE(is_valid(Date{2023, 2, 29}));
  EXPECT_FALSE(is_valid(Date{2023, 0, 1}));
  EXPECT_FALSE(is_valid(Date{2023, 1, 0}));
  EXPECT_FALSE(is_valid(Date{2023, 4, 31}));
  EXPECT_FALSE(is_valid(Date{0, 1, 1}));
  EXPECT_FALSE(is_valid(Date{10000, 1, 1}));
}

TEST(Utc, LeapSecondIsATimeOfDay) {
  EXPECT_TRUE(is_valid(TimeOfDay{23, 59, 60, 999'999'999}));
  EXPECT_FALSE(is_valid(TimeOfDay{23, 59, 61, 0}));
  EXPECT_FALSE(is_valid(TimeOfDay{24, 0, 0, 0}));
  EXPECT_FALSE(is_valid(TimeOfDay{0, 60, 0, 0}));
  EXPECT_FALSE(is_valid(TimeOfDay{0, 0, 0, 1'000'000'000}));
}

TEST(Utc, NanosecondsSince1970) {
  EXPECT_EQ(unix_ns({1970, 1, 1}, {}), 0);
  EXPECT_EQ(unix_ns({2023, 11, 14}, {22, 13, 20, 5}), 1'700'000'000'000'000'005);
  EXPECT_EQ(unix_ns({2016, 12, 31}, {23, 59, 60, 0}), unix_ns({2017, 1, 1}, {}));
}

TEST(Utc, ReadsIsoDatesAndNothingElse) {
  EXPECT_EQ(parse_iso_date("2019-04-07"), (Date{2019, 4, 7}));
  for (const char* text : {"", "2019-4-7", "2019-13-01", "2019-02-29", "19-04-07", "2019/04/07", "2019-04-07 ",
                           "+019-04-07", "2019-04-0x", "-019-04-07"}) {
    EXPECT_FALSE(parse_iso_date(text)) << text;
  }
}

TEST(Rollover, OneOrTwoEpochsAreAddedBeforeThePivot) {
  const auto one = correct_rollover({2000, 8, 25});
  EXPECT_TRUE(one.corrected);
  EXPECT_EQ(one.date, (Date{2020, 4, 10}));
  const auto two = correct_rollover({1981, 1, 9});
  EXPECT_TRUE(two.corrected);
  EXPECT_EQ(two.date, (Date{2020, 4, 10}));
}

TEST(Rollover, FromThePivotOnNothingIsTouched) {
  EXPECT_FALSE(correct_rollover({2019, 4, 7}).corrected);
  EXPECT_EQ(correct_rollover({2019, 4, 7}).date, (Date{2019, 4, 7}));
  EXPECT_EQ(correct_rollover({2019, 4, 6}).date, (Date{2038, 11, 20}));
  EXPECT_FALSE(correct_rollover({2099, 1, 1}).corrected);
}

TEST(Rollover, ThePivotIsAParameter) {
  EXPECT_FALSE(correct_rollover({2005, 4, 8}, {1999, 8, 22}).corrected);
  EXPECT_EQ(correct_rollover({2000, 8, 25}, {2026, 1, 1}).date, (Date{2039, 11, 25}));
}

TEST(Rollover, TheResultNeverLiesBeforeThePivotNorAnEpochBehindIt) {
  const auto begin = unix_ns(kRolloverPivot, {});
  constexpr std::int64_t kEpoch_ns = 7168LL * 86400 * 1'000'000'000;
  for (std::uint16_t year = 1980; year < 2019; ++year) {
    for (std::uint8_t month = 1; month <= 12; ++month) {
      const auto moved = unix_ns(correct_rollover({year, month, 17}).date, {});
      EXPECT_GE(moved, begin);
      EXPECT_LT(moved, begin + kEpoch_ns);
      EXPECT_EQ((moved - unix_ns({year, month, 17}, {})) % kEpoch_ns, 0);
    }
  }
}

TEST(Rollover, AnInvalidDateIsLeftAlone) {
  const auto result = correct_rollover({2000, 0, 0});
  EXPECT_FALSE(result.corrected);
  EXPECT_EQ(result.date, (Date{2000, 0, 0}));
}

TEST(Utc, DateAndTimeOfDayLeadBackToTheNumber) {
  for (const std::int64_t ns : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1'709'251'199'999'999'999},
                                std::int64_t{-86'400'000'000'000}, std::int64_t{4'102'444'800'000'000'000}})
    EXPECT_EQ(unix_ns(date_of(ns), time_of_day(ns)), ns);
  EXPECT_EQ(date_of(-1), (Date{1969, 12, 31}));
  EXPECT_EQ(time_of_day(-1), (TimeOfDay{23, 59, 59, 999'999'999}));
  EXPECT_EQ(date_of(1'709'164'800'000'000'000), (Date{2024, 2, 29}));
}

TEST(Utc, TwoDigitYears) {
  EXPECT_EQ(full_year(80), 1980);
  EXPECT_EQ(full_year(99), 1999);
  EXPECT_EQ(full_year(0), 2000);
  EXPECT_EQ(full_year(79), 2079);
}

}  // namespace
}  // namespace navcal::protocols
