// SPDX-License-Identifier: Apache-2.0
#include "config/document_bounds.h"

#include <fmt/format.h>

#include <algorithm>

namespace navcal::config {
namespace {

constexpr std::size_t kMaxBytes = 256 << 10;
constexpr int kMaxDots = 32;

bool begins_key(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-' ||
         c == '"' || c == '\'';
}

/// Of a line that begins with a bracket: what stands behind it is no name. An end too soon the parser tells
/// itself.
bool heads_no_table(std::string_view line) {
  constexpr std::string_view kBlank = " \t";
  const auto skip = [&](std::string_view what) {
    line.remove_prefix(std::min(line.find_first_not_of(what), line.size()));
  };
  skip(kBlank);
  if (!line.starts_with('[')) return false;
  line.remove_prefix(line.starts_with("[[") ? 2 : 1);
  skip(kBlank);
  return line.empty() || (line.front() != ']' && !begins_key(line.front()));
}

std::string complaint_about(std::string_view line) {
  if (heads_no_table(line)) return "a name is missing behind the bracket";
  int dots = 0;
  char quote = 0;  // within a text: the quote that ends it
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (static_cast<unsigned char>(c) >= 0x80)
      return "a character beyond ASCII; in quotes it can be written as \\u00E9";
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++at;
      if (c == quote) quote = 0;
    } else if (c == '#') {
      break;
    } else if (c == '"' || c == '\'') {
      if (line.substr(at, 3) == std::string(3, c)) return "a text over several lines is not taken";
      quote = c;
    } else if (c == '.' && ++dots > kMaxDots) {
      return fmt::format("the line has more than {} dots", kMaxDots);
    }
  }
  return {};
}

}  // namespace

std::optional<Problem> beyond_bounds(std::string_view toml) {
  if (toml.size() > kMaxBytes) return Problem{1, "", fmt::format("the file has more than {} bytes", kMaxBytes)};
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (toml.starts_with(kByteOrderMark)) toml.remove_prefix(kByteOrderMark.size());
  for (unsigned number = 1; !toml.empty(); ++number) {
    const std::size_t end = std::min(toml.find('\n'), toml.size());
    auto complaint = complaint_about(toml.substr(0, end));
    if (!complaint.empty()) return Problem{number, "", std::move(complaint)};
    toml.remove_prefix(std::min(end + 1, toml.size()));
  }
  return std::nullopt;
}

}  // namespace navcal::config
