// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace navcal::base {

/// Text of a file, a device or the network, made safe for a terminal or a journal: it moves no cursor and begins
/// no line. Control characters, but for those in `kept`, and bytes that are not UTF-8 become \u00XX, as in JSON.
[[nodiscard]] std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace navcal::base
