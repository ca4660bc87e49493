// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "record/json/json_members.h"

namespace navcal::web {

using record::json_text, record::member_of, record::number_in, record::text_in, record::vector_in;

/// 1 for true, 0 for false. Nullopt when the member is absent or no boolean.
[[nodiscard]] inline std::optional<double> flag_in(const nlohmann::json& object, const char* key) {
  const nlohmann::json& member = member_of(object, key);
  if (!member.is_boolean()) return std::nullopt;
  return member.get<bool>() ? 1.0 : 0.0;
}

/// `value` times `factor`; nullopt stays nullopt.
[[nodiscard]] inline std::optional<double> scaled(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

/// Words of an event, behind the port that it is about.
[[nodiscard]] inline std::string event_text(const nlohmann::json& event) {
  const std::string port = text_in(event, "port");
  return (port.empty() ? port : port + ": ") + text_in(event, "message");
}

}  // namespace navcal::web
