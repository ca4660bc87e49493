// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace navcal::protocols {

/// A day of the (proleptic) Gregorian calendar.
struct Date {
  std::uint16_t year = 0;
  std::uint8_t month = 0;  ///< 1-12
  std::uint8_t day = 0;    ///< 1-31

  constexpr auto operator<=>(const Date&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
};

struct TimeOfDay {
  std::uint8_t hour = 0;
  std::uint8_t minute = 0;
  std::uint8_t second = 0;  ///< 60 in a leap second
  std::uint32_t nanosecond = 0;
  constexpr auto operator<=>(const TimeOfDay&) const = default;  // NOLINT(modernize-use-nullptr): the same
};

/// Whether the date exists in the calendar, years 1 to 9999.
[[nodiscard]] bool is_valid(const Date& date);
[[nodiscard]] bool is_valid(const TimeOfDay& time);

/// Nanoseconds since 1970-01-01, leap seconds not counted: 23:59:60 is the same as the midnight that follows it.
[[nodiscard]] std::int64_t unix_ns(const Date& date, const TimeOfDay& time);

/// Day and time of day of such a number.
[[nodiscard]] Date date_of(std::int64_t unix_ns);
[[nodiscard]] TimeOfDay time_of_day(std::int64_t unix_ns);

/// "2019-04-07"; nothing else.
[[nodiscard]] std::optional<Date> parse_iso_date(std::string_view text);

/// Two-digit years of receivers: 80-99 are 1980-1999 (GPS time begins in 1980), 00-79 are 2000-2079.
[[nodiscard]] constexpr std::uint16_t full_year(unsigned two_digits) {
  return static_cast<std::uint16_t>(two_digits + (two_digits >= 80 ? 1900U : 2000U));
}

/// Dates from which receivers count that have not found the time: the beginning of GPS time (and all before 1981,
/// since they go on counting), and of its second epoch of 1024 weeks.
[[nodiscard]] constexpr bool is_start_of_count(const Date& date) {
  return date.year <= 1980 || (date >= Date{1999, 8, 21} && date <= Date{1999, 8, 22});
}

/// The date that a receiver means whose week counter of ten bits has rolled over.
struct CorrectedDate {
  Date date;
  bool corrected = false;  ///< at least one epoch of 1024 weeks was added
};

/// From this date on the week counter of GPS is in its third epoch (ICD section 2).
inline constexpr Date kRolloverPivot{2019, 4, 7};

/// Adds whole epochs of 1024 weeks while the date lies before `pivot`; the pivot is fixed by configuration, never
/// taken from a clock or a build, so that a recording is read alike for ever. An invalid date is returned as it
/// is.
[[nodiscard]] CorrectedDate correct_rollover(const Date& date, const Date& pivot = kRolloverPivot);

}  // namespace navcal::protocols
