// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace navcal::cli {

// What a NAV report says, for people.

/// One line: where it is thought to be, how sure that is, and since when no fix bears it out.
void append_navigation(std::string& out, const nlohmann::json& nav);
/// The reckoned position in a few words; empty while there are fixes, or none yet.
[[nodiscard]] std::string reckoned_words(const nlohmann::json& nav);

}  // namespace navcal::cli
