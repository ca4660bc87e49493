// SPDX-License-Identifier: Apache-2.0
#include "base/utc_text.h"

#include <array>
#include <chrono>
#include <cstdio>

namespace navcal::base {
namespace {

using Time = std::chrono::sys_time<std::chrono::nanoseconds>;

}  // namespace

std::string utc_date_text(std::int64_t utc_ns) {
  const std::chrono::year_month_day date(
      std::chrono::floor<std::chrono::days>(Time(std::chrono::nanoseconds(utc_ns))));
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text.data();
}

std::string utc_text(std::int64_t utc_ns) {
  // In milliseconds: the midnight before the smallest time has no number of nanoseconds.
  const auto utc = std::chrono::floor<std::chrono::milliseconds>(Time(std::chrono::nanoseconds(utc_ns)));
  const std::chrono::hh_mm_ss time(utc - std::chrono::floor<std::chrono::days>(utc));
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "T%02d:%02d:%02d.%03dZ", static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()),
                static_cast<int>(time.subseconds().count()));
  return utc_date_text(utc_ns) + text.data();
}

}  // namespace navcal::base
