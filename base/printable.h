// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace navcal::base {

/// Length of the UTF-8 character at the front of a text that is not empty; 0 where there is none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Text of a file, a device or the network, made safe for a terminal or a journal: it moves no cursor and begins
/// no line. Control characters, but for those in `kept`, and bytes that are not UTF-8 become \u00XX, as in JSON.
[[nodiscard]] std::string printable(std::string_view text, std::string_view kept = {});

/// Words of an exception, perhaps on several lines. Of a file error: the file and the reason.
[[nodiscard]] std::string printable(const std::exception& error);

}  // namespace navcal::base
