// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

/// An absent value is null, when it becomes JSON.
template <class Value>
struct nlohmann::adl_serializer<std::optional<Value>> {
  template <class Json>
  static void to_json(Json& json, const std::optional<Value>& value) {
    if (value)
      json = *value;
    else
      json = nullptr;
  }
};

/// Appends these members of `from` to the object `json`, each under its own name.
#define NAVCAL_PUT_MEMBERS(json, from, ...)                                  \
  [](auto& nlohmann_json_j, const auto& nlohmann_json_t) {                   \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
  }(json, from)

/// A type as an object of these members; to stand in the namespace of the type.
#define NAVCAL_JSON_MEMBERS(Type, ...)                                  \
  inline void to_json(nlohmann::ordered_json& json, const Type& from) { \
    NAVCAL_PUT_MEMBERS(json, from, __VA_ARGS__);                        \
  }
