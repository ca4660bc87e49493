// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

/// Length of a line of text for a terminal.
inline constexpr std::size_t kLineWidth = 110;

/// Pieces in lines of kLineWidth. The first piece stands at the end of `out`, which is column `indent`, and
/// further lines begin there.
void append_wrapped(std::string& out, std::size_t indent, const std::vector<std::string>& pieces,
                    std::string_view between);

/// Rows of cells as lines: columns as wide as their widest cell and two spaces apart, the first `left` of them
/// written from the left, the others from the right. No spaces at the end of a line.
[[nodiscard]] std::vector<std::string> table_lines(const std::vector<std::vector<std::string>>& rows,
                                                   std::size_t left);

/// The text with spaces in place of control characters, which would end a line or a comment.
[[nodiscard]] std::string printable(std::string_view text);

/// The words between spaces.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

}  // namespace navcal::report
