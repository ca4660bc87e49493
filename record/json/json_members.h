// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace navcal::record
