// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace navcal::protocols::nmea {

/// A number as a sentence says it: mantissa / 10^decimals. Exact, so that it can be shown again as it was sent.
struct Decimal {
  static constexpr std::size_t kMaxDigits = 15;  ///< any such mantissa is exact in a double

  std::int64_t mantissa = 0;
  std::uint8_t decimals = 0;

  /// The double nearest to the number (both operands of the one division are exact).
  [[nodiscard]] double value() const { return static_cast<double>(mantissa) / kPowersOfTen[decimals]; }
  constexpr bool operator==(const Decimal&) const = default;

  static constexpr std::array<double, kMaxDigits + 1> kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
};

/// [+-]digits[.digits], at least one digit, at most kMaxDigits of them; the whole text or nothing, no exponent.
[[nodiscard]] constexpr std::optional<Decimal> parse_decimal(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
  Decimal number;
  std::size_t digits = 0;
  bool point = false;
  for (const char c : text) {
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (c < '0' || c > '9' || ++digits > Decimal::kMaxDigits) return std::nullopt;
    number.mantissa = number.mantissa * 10 + (c - '0');
    if (point) ++number.decimals;
  }
  if (digits == 0) return std::nullopt;
  if (negative) number.mantissa = -number.mantissa;
  return number;
}

}  // namespace navcal::protocols::nmea
