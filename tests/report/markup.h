// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::cli::test {

/// Reason why a text is not XML, with its place; empty if it is well-formed: tags nested and closed, attributes
/// quoted, no bare `<` or `&`.
inline std::string flaw_in(std::string_view text) {
  const auto at = [&](std::size_t place) { return " at byte " + std::to_string(place); };
  if (text.starts_with("<!DOCTYPE html>")) text.remove_prefix(15);
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&') {
      const std::size_t end = text.find(';', i);
      if (end == std::string_view::npos || end - i > 8) return "bare &" + at(i);
    }
    if (text[i] == '>') return "bare >" + at(i);
    if (text[i] != '<') {
      if (open.empty() && std::isspace(static_cast<unsigned char>(text[i])) == 0) return "text outside" + at(i);
      continue;
    }
    std::size_t end = i + 1;
    bool quoted = false;
    for (; end < text.size() && (quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '<') return "bare <" + at(end);
    }
    if (end == text.size()) return "a tag that does not end" + at(i);
    const std::string_view tag = text.substr(i + 1, end - i - 1);
    const std::string name(tag.substr(0, tag.find_first_of(" /\n", 1)));
    if (name.empty()) return "a tag without a name" + at(i);
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "wrong end of " + std::string(tag) + at(i);
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty() ? std::string() : open.back() + " is not closed";
}

/// How often `part` occurs.
inline int count(std::string_view text, std::string_view part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace navcal::cli::test
