// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace navcal::config {

/// "; did you mean sync_interval_s?" when one of the known words is near enough to be meant, else nothing.
[[nodiscard]] std::string suggestion(std::string_view given, const std::vector<std::string>& known);
/// The same, and "; known: a, b" with all of them when none is near enough.
[[nodiscard]] std::string suggestion_or_all(std::string_view given, const std::vector<std::string>& known);

}  // namespace navcal::config
