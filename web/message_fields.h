// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace navcal::web {

// Single members of a message of the log, without parsing the whole. Keys with the same name deeper in the message
// are not told apart: the first one counts. navcald writes its JSON without blanks.

/// Text of the value of `key`, of a string without its quotes; empty when there is none. Ends at a comma or brace,
/// so it is not for lists and objects.
[[nodiscard]] std::string_view member_text(std::string_view message, std::string_view key);
/// Nullopt when the member is absent, null or not a number.
[[nodiscard]] std::optional<double> member_number(std::string_view message, std::string_view key);

}  // namespace navcal::web
