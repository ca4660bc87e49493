// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// Members of JSON that somebody else has written. What is no object has no members.
namespace navcal::record {

/// The member, or null (which has no members) when it is absent.
template <class Json>
[[nodiscard]] const Json& member_of(const Json& object, const char* key) {
  static const Json kNone;
  const auto found = object.find(key);
  return found != object.end() ? *found : kNone;
}

/// Nullopt when the member is absent, null, of another type or not finite.
template <class Json>
[[nodiscard]] std::optional<double> number_in(const Json& object, const char* key) {
  const Json& member = member_of(object, key);
  const double value = member.is_number() ? member.template get<double>() : std::nan("");
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Empty when the member is absent or no text.
template <class Json>
[[nodiscard]] std::string text_in(const Json& object, const char* key) {
  const Json& member = member_of(object, key);
  return member.is_string() ? member.template get<std::string>() : std::string();
}

/// Nullopt when the member is absent or no list of three finite numbers.
template <class Json>
[[nodiscard]] std::optional<std::array<double, 3>> vector_in(const Json& object, const char* key) {
  const Json& member = member_of(object, key);
  if (!member.is_array() || member.size() != 3) return std::nullopt;
  std::array<double, 3> all{};
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] = member[i].is_number() ? member[i].template get<double>() : std::nan("");
    if (!std::isfinite(all[i])) return std::nullopt;
  }
  return all;
}

/// One line, with U+FFFD in place of what is no UTF-8.
template <class Json = nlohmann::ordered_json>
[[nodiscard]] std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace navcal::record
