// SPDX-License-Identifier: Apache-2.0
#include "report/wrapped_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace navcal::report {

void append_wrapped(std::string& out, std::size_t indent, const std::vector<std::string>& pieces,
                    std::string_view between) {
  std::size_t column = indent;
  bool begins = true;
  for (const std::string& piece : pieces) {
    if (!begins && column + between.size() + piece.size() > kLineWidth) {
      out.append(between.substr(0, between.find_last_not_of(' ') + 1)).append("\n").append(indent, ' ');
      column = indent;
      begins = true;
    }
    if (!begins) out += between;
    out += piece;
    column += piece.size() + (begins ? 0 : between.size());
    begins = false;
  }
  out += '\n';
}

std::vector<std::string> table_lines(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += "  ";
      line += i < left ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("{:>{}}", row[i], widths[i]);
    }
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1) + '\n');
  }
  return lines;
}

std::string printable(std::string_view text) {
  std::string out(text);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
  return out;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end > begin) words.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace navcal::report
