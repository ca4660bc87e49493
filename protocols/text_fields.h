// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

/// Fields between commas, as instruments print them.
namespace navcal::protocols {

/// Splits `text` at its commas; nullopt unless there are exactly N fields.
template <std::size_t N>
[[nodiscard]] std::optional<std::array<std::string_view, N>> split_exactly(std::string_view text) {
  std::array<std::string_view, N> fields;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == N)) return std::nullopt;
    fields[i] = text.substr(0, comma);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return fields;
}

/// The whole of `text` as a finite number with an optional sign and exponent, blanks before it allowed.
[[nodiscard]] inline std::optional<double> signed_number(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The fields of `text` as numbers; nullopt unless there are exactly N.
template <std::size_t N>
[[nodiscard]] std::optional<std::array<double, N>> numbers(std::string_view text) {
  const auto fields = split_exactly<N>(text);
  if (!fields) return std::nullopt;
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = signed_number((*fields)[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

}  // namespace navcal::protocols
