// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::protocols {

/// Takes a plain decimal number (`-12.4`, `3`) from the front of `text`, whatever the locale. No exponent, so that
/// `12.8E002` leaves `E002` in `text`; no sign but `-`; neither "nan" nor "inf". nullopt: there is none, `text` is
/// untouched.
[[nodiscard]] inline std::optional<double> take_decimal(std::string_view& text) {
  const std::size_t digit = !text.empty() && text.front() == '-' ? 1 : 0;
  if (text.size() <= digit || ((text[digit] < '0' || text[digit] > '9') && text[digit] != '.'))
    return std::nullopt;
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Takes a word from the front of `text`, with the blanks and ends of lines before it. Empty: there is none.
[[nodiscard]] constexpr std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \n"), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(" \n"));
  text.remove_prefix(word.size());
  return word;
}

/// The whole of `text` as a plain decimal number.
[[nodiscard]] inline std::optional<double> decimal(std::string_view text) {
  const std::optional<double> value = take_decimal(text);
  return text.empty() ? value : std::nullopt;
}

/// The whole of `text` as an integer of type T; nullopt when it is none or does not fit.
template <std::integral T>
[[nodiscard]] std::optional<T> integer(std::string_view text, int base = 10) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The whole of `text` as a number, with or without an exponent, or "inf" or "nan".
[[nodiscard]] inline std::optional<double> real(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Appends `value` with a fixed number of decimals (0 to 6), as instruments print it: no `-` before a zero.
/// `value` must be finite and smaller than 1e15 in size.
inline void append_decimal(std::string& text, double value, int decimals) {
  assert(std::isfinite(value) && std::abs(value) < 1e15 && decimals >= 0 && decimals <= 6);
  char digits[32];
  const auto [end, error] =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals);
  assert(error == std::errc{});
  std::string_view printed(digits, static_cast<std::size_t>(end - digits));
  if (printed.find_first_not_of("-0.") == std::string_view::npos && printed.front() == '-')
    printed.remove_prefix(1);
  text += printed;
}

/// Appends `value` with the fewest digits that identify it.
inline void append_shortest(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, static_cast<std::size_t>(end - digits));
}

/// Appends `value` in upper-case hexadecimal, filled up with zeros to `least_digits`.
inline void append_hex(std::string& text, std::uint32_t value, std::size_t least_digits) {
  char digits[8];
  const auto n = static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, value, 16).ptr - digits);
  if (n < least_digits) text.append(least_digits - n, '0');
  for (std::size_t i = 0; i < n; ++i)
    text += digits[i] >= 'a' ? static_cast<char>(digits[i] - 'a' + 'A') : digits[i];
}

}  // namespace navcal::protocols
