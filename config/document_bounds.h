// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "config/document.h"

namespace navcal::config {

/// Checks a file, before it is parsed, for what toml++ 3.3 would not survive. No real configuration comes near
/// it.
/// - toml++ frees nested tables recursively. It bounds nested values but not dotted keys, so that some ten
///   thousand levels end the process. So a file has a greatest size, and a line a greatest number of dots.
/// - A character beyond ASCII outside comments can be undefined behaviour (tomlplusplus issues 190 and 295), so it
///   must be written as an escape; and texts over several lines, which nothing here needs, are not taken.
/// - toml++ assumes a name behind the bracket of a table without looking: another character is undefined
///   behaviour.
[[nodiscard]] std::optional<Problem> beyond_bounds(std::string_view toml);

}  // namespace navcal::config
