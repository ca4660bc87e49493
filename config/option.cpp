// SPDX-License-Identifier: Apache-2.0
#include "config/option.h"

#include <fmt/format.h>

#include <algorithm>

namespace navcal::config {
namespace {

std::string alternatives(const std::vector<std::string_view>& choices) {
  std::string out;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) out += i + 1 == choices.size() ? " or " : ", ";
    out += choices[i];
  }
  return out;
}

}  // namespace

std::string OptionInfo::name() const {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

std::string OptionInfo::allowed() const {
  const std::string unit_after = unit.name.empty() ? "" : fmt::format(" {}", unit.name);
  std::string range = octal ? fmt::format("0o{:03o} to 0o{:03o}", static_cast<int>(low), static_cast<int>(high))
                            : fmt::format("{} to {}{}", low, high, unit_after);
  switch (kind) {
    case Kind::boolean: return "true or false";
    case Kind::integer:
    case Kind::real: return range;
    case Kind::channels:
      return fmt::format("{} numbers, each {}{}", count == 3 ? "three" : "eight", range,
                         zero_allowed ? "" : " and not 0");
    case Kind::choice: return alternatives(choices);
    case Kind::text: return std::string(text_rule);
    case Kind::list: return fmt::format("a list of texts, each {}", text_rule);
  }
  return {};
}

bool OptionInfo::applies_to(protocols::Protocol protocol) const {
  return only_for.empty() || std::find(only_for.begin(), only_for.end(), protocol) != only_for.end();
}

std::optional<std::string> OptionInfo::adopt(Value& value) const {
  const auto wrong_type = [&](std::string_view wanted) {
    return fmt::format("{} is expected ({}), not {}", wanted, allowed(), words_for(value));
  };
  const auto out_of_range = [&](double number) {
    // Written so that NaN is outside.
    return !(number >= low && number <= high) || (number == 0 && !zero_allowed);
  };
  const auto out_of_range_words = [&](double number) {
    return fmt::format("{} is out of range: {}", number, allowed());
  };
  const std::string a_number = unit.name.empty() ? "a number" : fmt::format("a number in {}", unit.name);

  switch (kind) {
    case Kind::boolean:
      if (!std::holds_alternative<bool>(value))
        return fmt::format("true or false is expected, not {}", words_for(value));
      return std::nullopt;
    case Kind::integer: {
      const auto* whole = std::get_if<std::int64_t>(&value);
      if (whole == nullptr) return wrong_type("a whole number");
      if (!out_of_range(static_cast<double>(*whole))) return std::nullopt;
      return fmt::format("{} is out of range: {}", *whole < 0 ? std::to_string(*whole) : write(value), allowed());
    }
    case Kind::real: {
      if (const auto* whole = std::get_if<std::int64_t>(&value)) value = static_cast<double>(*whole);
      const auto* number = std::get_if<double>(&value);
      if (number == nullptr) return wrong_type(a_number);
      if (out_of_range(*number)) return out_of_range_words(*number);
      return std::nullopt;
    }
    case Kind::channels: {
      const auto* numbers = std::get_if<std::vector<double>>(&value);
      if (numbers == nullptr || numbers->size() != count) {
        return fmt::format("{} are expected, not {}", allowed(), words_for(value));
      }
      const auto bad = std::find_if(numbers->begin(), numbers->end(), out_of_range);
      if (bad != numbers->end()) return out_of_range_words(*bad);
      return std::nullopt;
    }
    case Kind::choice: {
      const auto* text = std::get_if<std::string>(&value);
      if (text == nullptr) return wrong_type("a text");
      if (std::find(choices.begin(), choices.end(), *text) != choices.end()) return std::nullopt;
      return fmt::format("unknown {} {}; known: {}", key, to_toml_text(value), alternatives(choices));
    }
    case Kind::text: {
      const auto* text = std::get_if<std::string>(&value);
      if (text == nullptr) return wrong_type("a text");
      if (!text_holds(*text)) return fmt::format("{} is not {}", to_toml_text(value), text_rule);
      return std::nullopt;
    }
    case Kind::list: {
      // An empty array of a file does not say of what it is.
      if (value == Value(std::vector<double>())) value = std::vector<std::string>();
      const auto* texts = std::get_if<std::vector<std::string>>(&value);
      if (texts == nullptr) return fmt::format("{} is expected, not {}", allowed(), words_for(value));
      const auto bad = std::find_if_not(texts->begin(), texts->end(), text_holds);
      if (bad != texts->end()) return fmt::format("{} is not {}", to_toml_text(Value(*bad)), text_rule);
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::string OptionInfo::write(const Value& value) const {
  if (octal) return fmt::format("0o{:03o}", std::get<std::int64_t>(value));
  return to_toml_text(value);
}

}  // namespace navcal::config
