#include "config/value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace navcal::config {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
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
  std::string operator()(const std::string& value) const { return "the text " + quoted(value); }
  std::string operator()(const std::vector<double>& value) const {
    return fmt::format("an array of {} numbers", value.size());
  }
};

struct Toml {
  std::string operator()(Table) const { return "{}"; }
  std::string operator()(const Unsupported& other) const { return other.words; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return quoted(value); }
  std::string operator()(const std::vector<double>& value) const {
    return fmt::format("[{}]", fmt::join(value, ", "));
  }
};

}  // namespace

std::string words_for(const Value& value) { return std::visit(Words{}, value); }

std::string to_toml_text(const Value& value) { return std::visit(Toml{}, value); }

}  // namespace navcal::config
