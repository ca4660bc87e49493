#include "config/document_bounds.h"

#include <fmt/format.h>

#include <algorithm>

namespace navcal::config {
namespace {

constexpr std::size_t kMaxBytes = 256 * 1024;
constexpr int kMaxDots = 32;

std::string complaint_about(std::string_view line) {
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
