// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::base {

/// Lines of a text that is part of the program (navcal_text() of cmake/options.cmake): what stands before the
/// first separator, and behind it. Empty lines are left out. They are views of `text`.
[[nodiscard]] inline std::vector<std::pair<std::string_view, std::string_view>> text_rows(
    std::string_view text, std::string_view separator) {
  std::vector<std::pair<std::string_view, std::string_view>> rows;
  while (!text.empty()) {
    const std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), row.size() + 1));
    if (row.empty()) continue;
    const std::size_t end = std::min(row.find(separator), row.size());
    rows.emplace_back(row.substr(0, end), row.substr(std::min(row.size(), end + separator.size())));
  }
  return rows;
}

}  // namespace navcal::base
