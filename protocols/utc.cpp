// SPDX-License-Identifier: Apache-2.0
#include "protocols/utc.h"

#include <chrono>

#include "protocols/decimal.h"

namespace navcal::protocols {
namespace {

constexpr int kDaysPerEpoch = 1024 * 7;

std::chrono::year_month_day calendar(const Date& date) {
  return std::chrono::year{date.year} / std::chrono::month{date.month} / std::chrono::day{date.day};
}

Date date_of_day(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return {static_cast<std::uint16_t>(static_cast<int>(date.year())),
          static_cast<std::uint8_t>(static_cast<unsigned>(date.month())),
          static_cast<std::uint8_t>(static_cast<unsigned>(date.day()))};
}

/// Negative before 1970, too.
std::chrono::sys_days day_of(std::int64_t unix_ns) {
  return std::chrono::floor<std::chrono::days>(
      std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(unix_ns)));
}

}  // namespace

bool is_valid(const Date& date) { return date.year >= 1 && date.year <= 9999 && calendar(date).ok(); }

bool is_valid(const TimeOfDay& time) {
  return time.hour <= 23 && time.minute <= 59 && time.second <= 60 && time.nanosecond <= 999'999'999;
}

std::int64_t unix_ns(const Date& date, const TimeOfDay& time) {
  const auto days = std::chrono::sys_days{calendar(date)}.time_since_epoch().count();
  const std::int64_t seconds = (days * 24LL + time.hour) * 3600 + time.minute * 60LL + time.second;
  return seconds * 1'000'000'000 + time.nanosecond;
}

Date date_of(std::int64_t unix_ns) { return date_of_day(day_of(unix_ns)); }

TimeOfDay time_of_day(std::int64_t unix_ns) {
  const std::chrono::hh_mm_ss time(std::chrono::nanoseconds(unix_ns) - day_of(unix_ns).time_since_epoch());
  return {static_cast<std::uint8_t>(time.hours().count()), static_cast<std::uint8_t>(time.minutes().count()),
          static_cast<std::uint8_t>(time.seconds().count()),
          static_cast<std::uint32_t>(time.subseconds().count())};
}

std::optional<Date> parse_iso_date(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const auto year = integer<std::uint16_t>(text.substr(0, 4));
  const auto month = integer<std::uint8_t>(text.substr(5, 2)), day = integer<std::uint8_t>(text.substr(8, 2));
  const Date date{year.value_or(0), month.value_or(0), day.value_or(0)};
  return is_valid(date) ? std::optional(date) : std::nullopt;
}

CorrectedDate correct_rollover(const Date& date, const Date& pivot) {
  if (!is_valid(date) || date >= pivot) return {date, false};
  const std::chrono::sys_days day{calendar(date)};
  const auto missing = (std::chrono::sys_days{calendar(pivot)} - day).count();
  const auto epochs = (missing + kDaysPerEpoch - 1) / kDaysPerEpoch;
  return {date_of_day(day + std::chrono::days{epochs * kDaysPerEpoch}), true};
}

}  // namespace navcal::protocols
