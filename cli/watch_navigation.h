// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace navcal::cli {

// Text of a NAV report, for people.

/// Appends one line: position and its error, heading, speed, depth; while reckoned, time and way since the last
/// fix.
void append_navigation(std::string& out, const nlohmann::json& nav);
/// The reckoned position in a few words; empty while there are fixes, or none yet.
[[nodiscard]] std::string reckoned_words(const nlohmann::json& nav);

}  // namespace navcal::cli
