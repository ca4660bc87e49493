// SPDX-License-Identifier: Apache-2.0
#include "protocols/utc.h"

#include <charconv>
#include <chrono>

namespace navcal::protocols {
namespace {

constexpr int kDaysPerEpoch = 1024 * 7;

std::chrono::year_month_day calendar(const Date& date) {
  return std::chrono::year{date.year} / std::chrono::month{date.month} / std::chrono::day{date.day};
}

template <class Number>
bool read(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
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

std::optional<Date> parse_iso_date(std::string_view text) {
  Date date;
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  if (!read(text.substr(0, 4), date.year) || !read(text.substr(5, 2), date.month) ||
      !read(text.substr(8, 2), date.day) || !is_valid(date)) {
    return std::nullopt;
  }
  return date;
}

CorrectedDate correct_rollover(const Date& date, const Date& pivot) {
  if (!is_valid(date) || date >= pivot) return {date, false};
  const std::chrono::sys_days day{calendar(date)};
  const auto missing = (std::chrono::sys_days{calendar(pivot)} - day).count();
  const auto epochs = (missing + kDaysPerEpoch - 1) / kDaysPerEpoch;
  const std::chrono::year_month_day moved{day + std::chrono::days{epochs * kDaysPerEpoch}};
  return {Date{static_cast<std::uint16_t>(static_cast<int>(moved.year())),
               static_cast<std::uint8_t>(static_cast<unsigned>(moved.month())),
               static_cast<std::uint8_t>(static_cast<unsigned>(moved.day()))},
          true};
}

}  // namespace navcal::protocols
