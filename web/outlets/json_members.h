// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace navcal::web {

/// Number of a member. Nullopt when the member is absent, null, of another type or not finite.
[[nodiscard]] inline std::optional<double> number_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// 1 for true, 0 for false. Nullopt when the member is absent or no boolean.
[[nodiscard]] inline std::optional<double> flag_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_boolean()) return std::nullopt;
  return found->get<bool>() ? 1.0 : 0.0;
}

/// Empty when the member is absent or no text.
[[nodiscard]] inline std::string text_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The member, or null (of which `find` finds nothing) when it is absent.
[[nodiscard]] inline const nlohmann::json& member_of(const nlohmann::json& object, const char* key) {
  static const nlohmann::json kNone;
  const auto found = object.find(key);
  return found != object.end() ? *found : kNone;
}

/// `value` times `factor`; nullopt stays nullopt.
[[nodiscard]] inline std::optional<double> scaled(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

}  // namespace navcal::web
