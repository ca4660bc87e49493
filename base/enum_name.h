// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace navcal::base {

/// Name of a value of an enumeration by a table in the order of its enumerators, from zero on; `last` is the last
/// one: a table of another length does not compile. Empty for a value that is none of them.
template <auto last, std::size_t count>
[[nodiscard]] constexpr std::string_view enum_name(decltype(last) value, const std::string_view (&names)[count]) {
  static_assert(count == static_cast<std::size_t>(last) + 1, "the table has a name for each enumerator");
  const auto index = static_cast<std::size_t>(value);
  return index < count ? names[index] : std::string_view{};
}

/// The enumerator that `name_of` gives this name, of those from zero to `last`.
template <auto last, class NameOf>
[[nodiscard]] constexpr std::optional<decltype(last)> enum_named(std::string_view name, NameOf name_of) {
  for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i) {
    if (name_of(static_cast<decltype(last)>(i)) == name) return static_cast<decltype(last)>(i);
  }
  return std::nullopt;
}

}  // namespace navcal::base
