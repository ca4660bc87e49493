// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace navcal::cli {

// Text of a daemon's report, made safe for a terminal. Nothing is trusted: any member may be missing or of any
// type.

/// The text at `key`, printable; empty when there is none.
[[nodiscard]] std::string text(const nlohmann::json& object, const char* key);

/// The number at `key`; not-a-number when there is none.
[[nodiscard]] double number(const nlohmann::json& object, const char* key);

/// "-" for what is not there.
[[nodiscard]] std::string shown(double value, int decimals);
/// The number at `key`.
[[nodiscard]] std::string shown(const nlohmann::json& object, const char* key, int decimals);

}  // namespace navcal::cli
