#pragma once

#include <optional>
#include <string_view>

#include "config/document.h"

namespace navcal::config {

/// What toml++ 3.3 would not survive, refused before it reads a file; no real configuration comes near it.
/// - It frees nested tables recursively and bounds nested values but not dotted keys: some ten thousand levels end
///   the process. So a file has a greatest size, and a line a greatest number of dots.
/// - A character beyond ASCII outside quotes and comments, or after a backslash at the end of a line in a text
/// over
///   several lines, is undefined behaviour (tomlplusplus issues 190, 295). So both are refused.
[[nodiscard]] std::optional<Problem> beyond_bounds(std::string_view toml);

}  // namespace navcal::config
