// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/document.h"
#include "config/error.h"

namespace navcal::config {

/// Throws Error with all problems of this file, in its order, the command line's last; nothing when there are
/// none.
void refuse(std::vector<Problem> problems, std::string_view file);

/// All bytes of a file. Throws Error when it cannot be read.
[[nodiscard]] std::string content_of(const std::filesystem::path& file);

/// "; did you mean sync_interval_s?" when one of the known words is near enough to be meant, else nothing.
[[nodiscard]] std::string suggestion(std::string_view given, const std::vector<std::string>& known);
/// The same, and "; known: a, b" with all of them when none is near enough.
[[nodiscard]] std::string suggestion_or_all(std::string_view given, const std::vector<std::string>& known);

}  // namespace navcal::config
