// SPDX-License-Identifier: Apache-2.0
#include "config/value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace navcal::config {
namespace {

constexpr char32_t kNoCharacter = 0xfffd;

/// Takes one character off the front of UTF-8 text; kNoCharacter for a byte that begins none.
char32_t take_character(std::string_view& text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 0;
  char32_t character = length == 1 ? first : first & (0x7fU >> length);
  bool whole = length > 0 && length <= text.size();
  for (std::size_t i = 1; whole && i < length; ++i) {
    whole = (byte(i) & 0xc0U) == 0x80;
    character = character << 6U | (byte(i) & 0x3fU);
  }
  text.remove_prefix(whole ? length : 1);
  return whole ? character : kNoCharacter;
}

/// Quotes a text; every character that is not ASCII is escaped (see beyond_bounds() in document.cpp).
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const char32_t c = take_character(text);
    if (c == U'"' || c == U'\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else if (c == U'\n') {
      out += "\\n";
    } else if (c >= 0x20 && c < 0x7f) {
      out += static_cast<char>(c);
    } else if (c <= 0xffff) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += fmt::format("\\U{:08X}", static_cast<unsigned>(c));
    }
  }
  return out + '"';
}

struct Words {
  std::string operator()(Table) const { return "a table"; }
  std::string operator()(const Unsupported& other) const { return other.words; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("the number {}", value); }
  std::string operator()(double value) const { return fmt::format("the number {}", value); }
  std::string operator()(const std::string& value) const { return "the text " + in_quotes(value); }
  std::string operator()(const std::vector<double>& value) const {
    return fmt::format("an array of {} numbers", value.size());
  }
  std::string operator()(const std::vector<std::string>& value) const {
    return fmt::format("an array of {} texts", value.size());
  }
};

struct Toml {
  std::string operator()(Table) const { return "{}"; }
  std::string operator()(const Unsupported& other) const { return other.words; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return in_quotes(value); }
  std::string operator()(const std::vector<double>& value) const {
    return fmt::format("[{}]", fmt::join(value, ", "));
  }
  std::string operator()(const std::vector<std::string>& value) const {
    std::string out = "[";
    for (const std::string& text : value) out += (out.size() > 1 ? ", " : "") + in_quotes(text);
    return out + "]";
  }
};

}  // namespace

std::string words_for(const Value& value) { return std::visit(Words{}, value); }

std::string to_toml_text(const Value& value) { return std::visit(Toml{}, value); }

}  // namespace navcal::config
