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

}  // namespace navcal::config
