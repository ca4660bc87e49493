// SPDX-License-Identifier: Apache-2.0
#include "config/described/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "config/complaints.h"
#include "protocols/decimal.h"

namespace navcal::config {
namespace {

std::string range_words(double low, double high, std::string_view unit) {
  return fmt::format("{} to {}{}{}", low, high, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::optional<std::string> bytes_of_hex(std::string_view text) {
  std::string bytes;
  while (true) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    if (text.empty()) return bytes;
    const auto value = protocols::integer<std::uint8_t>(text.substr(0, 2), 16);
    if (!value || text.size() < 2) return std::nullopt;
    bytes += static_cast<char>(*value);
    text.remove_prefix(2);
  }
}

const Node* TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  const auto found = std::ranges::find(table_.children, key, &Node::key);
  return found == table_.children.end() ? nullptr : &*found;
}

void TableReader::complain(std::string_view key, std::string message) {
  const Node* node = find(key);
  const std::string name = table_.name.empty() ? std::string(key) : fmt::format("{}.{}", table_.name, key);
  problems_.push_back({node != nullptr ? node->line : table_.line, name, std::move(message)});
}

void TableReader::require(std::string_view key, std::string_view what) {
  if (!has(key)) complain(key, fmt::format("missing; {}", what));
}

void TableReader::refuse(const Node& node, std::string_view wanted) {
  const std::string given = node.is_list ? "an array of tables" : words_for(node.value);
  problems_.push_back({node.line, node.name, fmt::format("{} is expected, not {}", wanted, given)});
}

std::optional<std::string> TableReader::text(std::string_view key) {
  const Node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* text = std::get_if<std::string>(&node->value)) return *text;
  refuse(*node, "a text");
  return std::nullopt;
}

std::optional<double> TableReader::number(std::string_view key, double low, double high, std::string_view unit) {
  const Node* node = find(key);
  if (node == nullptr) return std::nullopt;
  std::optional<double> number;
  if (const auto* whole = std::get_if<std::int64_t>(&node->value)) number = static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&node->value)) number = *real;
  if (!number) {
    refuse(*node, fmt::format("a number ({})", range_words(low, high, unit)));
  } else if (!(*number >= low && *number <= high)) {  // written so that NaN is outside
    complain(key, fmt::format("{} is out of range: {}", *number, range_words(low, high, unit)));
    number.reset();
  }
  return number;
}

std::optional<std::int64_t> TableReader::whole(std::string_view key, std::int64_t low, std::int64_t high) {
  const Node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto* number = std::get_if<std::int64_t>(&node->value);
  if (number == nullptr) {
    refuse(*node, fmt::format("a whole number ({} to {})", low, high));
    return std::nullopt;
  }
  if (*number >= low && *number <= high) return *number;
  complain(key, fmt::format("{} is out of range: {} to {}", *number, low, high));
  return std::nullopt;
}

std::optional<std::string> TableReader::choice(std::string_view key, const std::vector<std::string>& known) {
  auto word = text(key);
  if (!word || std::find(known.begin(), known.end(), *word) != known.end()) return word;
  complain(key, fmt::format("unknown {} {}{}", key, to_toml_text(*word), suggestion_or_all(*word, known)));
  return std::nullopt;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
  const Node* node = find(key);
  if (node == nullptr || node->value == Value(std::vector<double>())) return {};
  if (const auto* texts = std::get_if<std::vector<std::string>>(&node->value)) return *texts;
  refuse(*node, "a list of texts");
  return {};
}

std::optional<std::pair<int, int>> TableReader::pair(std::string_view key, int low, int high) {
  const Node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto* numbers = std::get_if<std::vector<double>>(&node->value);
  const auto holds = [&](double number) {
    return number >= low && number <= high && number == static_cast<int>(number);
  };
  if (numbers != nullptr && numbers->size() == 2 && holds((*numbers)[0]) && holds((*numbers)[1]))
    return std::pair(static_cast<int>((*numbers)[0]), static_cast<int>((*numbers)[1]));
  refuse(*node, fmt::format("[FIRST, LAST], each {} to {},", low, high));
  return std::nullopt;
}

std::vector<const Node*> TableReader::tables(std::string_view key) {
  const Node* node = find(key);
  std::vector<const Node*> tables;
  if (node == nullptr || node->value == Value(std::vector<double>())) return tables;
  if (node->is_list) {
    for (const Node& child : node->children) tables.push_back(&child);
  } else if (std::holds_alternative<Table>(node->value)) {
    tables.push_back(node);
  } else {
    refuse(*node, "a list of tables");
  }
  return tables;
}

std::optional<std::string> TableReader::bytes(std::string_view key) {
  const auto given = text(key);
  if (!given) return std::nullopt;
  auto bytes = bytes_of_hex(*given);
  if (!bytes)
    complain(key, fmt::format("{} are no bytes in hexadecimal, such as \"A5 5A\"", to_toml_text(*given)));
  return bytes;
}

std::optional<char> TableReader::character(std::string_view key) {
  const auto given = text(key);
  if (!given) return std::nullopt;
  if (given->size() == 1) return given->front();
  complain(key, fmt::format("{} is not one character", to_toml_text(*given)));
  return std::nullopt;
}

void TableReader::finish() {
  for (const Node& child : table_.children) {
    if (std::find(known_.begin(), known_.end(), child.key) != known_.end()) continue;
    problems_.push_back({child.line, child.name, "unknown key" + suggestion_or_all(child.key, known_)});
  }
}

}  // namespace navcal::config
