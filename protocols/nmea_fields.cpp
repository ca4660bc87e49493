// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_fields.h"

#include <algorithm>
#include <cmath>

namespace navcal::protocols::nmea {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<unsigned> whole(std::string_view digits) {
  unsigned number = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return std::nullopt;
    number = number * 10 + static_cast<unsigned>(c - '0');
  }
  return number;
}

}  // namespace

std::optional<Decimal> FieldReader::signed_by_letter(char positive, char negative, double limit) {
  auto number = decimal(-limit, limit);
  const char sign = letter();
  if (!number) return std::nullopt;
  if (sign == negative) {
    number->mantissa = -number->mantissa;
  } else if (sign != positive) {
    refuse();
  }
  return number;
}

std::optional<TimeOfDay> FieldReader::time_of_day() {
  constexpr std::size_t kWhole = 6;
  constexpr std::size_t kDecimals = 9;
  const std::string_view field = text();
  if (field.empty()) return std::nullopt;
  const auto hhmmss = whole(field.substr(0, kWhole));
  if (field.size() < kWhole || !hhmmss || (field.size() > kWhole && field[kWhole] != '.')) {
    refuse();
    return std::nullopt;
  }
  TimeOfDay time;
  time.hour = static_cast<std::uint8_t>(*hhmmss / 10000);
  time.minute = static_cast<std::uint8_t>(*hhmmss / 100 % 100);
  time.second = static_cast<std::uint8_t>(*hhmmss % 100);
  const std::string_view fraction = field.substr(std::min(field.size(), kWhole + 1));
  std::uint32_t unit = 100'000'000;
  for (std::size_t i = 0; i < fraction.size(); ++i) {
    if (!is_digit(fraction[i])) {
      refuse();
      return std::nullopt;
    }
    if (i >= kDecimals) continue;
    time.nanosecond += static_cast<std::uint32_t>(fraction[i] - '0') * unit;
    unit /= 10;
  }
  if (!is_valid(time)) {
    refuse();
    return std::nullopt;
  }
  return time;
}

std::optional<LatLon> FieldReader::lat_lon() {
  const auto latitude = coordinate(2, 'N', 'S', 90);
  const auto longitude = coordinate(3, 'E', 'W', 180);
  if (!latitude || !longitude) return std::nullopt;
  return LatLon{*latitude, *longitude};
}

std::optional<double> FieldReader::coordinate(std::size_t degree_digits, char positive, char negative,
                                              double limit) {
  const std::string_view field = text();
  const char side = letter();
  if (field.empty()) return std::nullopt;
  const auto degrees = whole(field.substr(0, degree_digits));
  const auto minutes = parse_decimal(field.substr(std::min(field.size(), degree_digits)));
  if (field.size() < degree_digits + 2 || !is_digit(field[degree_digits]) || !degrees || !minutes ||
      minutes->value() >= 60 || (side != positive && side != negative)) {
    refuse();
    return std::nullopt;
  }
  const double angle = *degrees + minutes->value() / 60;
  if (angle > limit) {
    refuse();
    return std::nullopt;
  }
  return side == negative ? -angle : angle;
}

}  // namespace navcal::protocols::nmea
