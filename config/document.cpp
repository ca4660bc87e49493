// SPDX-License-Identifier: Apache-2.0
#include "config/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/line_reader.h"

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

/// Checks a file, before it is parsed, for what toml++ 3.3 would not survive. No real configuration comes near
/// it.
/// - toml++ frees nested tables recursively. It bounds nested values but not dotted keys, so that some ten
///   thousand levels end the process. So a file has a greatest size, and a line a greatest number of dots.
/// - A character beyond ASCII outside comments can be undefined behaviour (tomlplusplus issues 190 and 295), so it
///   must be written as an escape; and texts over several lines, which nothing here needs, are not taken.
/// - toml++ assumes a name behind the bracket of a table without looking: another character is undefined
///   behaviour.
std::optional<Problem> beyond_bounds(std::string_view toml) {
  if (toml.size() > kMaxBytes) return Problem{1, "", fmt::format("the file has more than {} bytes", kMaxBytes)};
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (toml.starts_with(kByteOrderMark)) toml.remove_prefix(kByteOrderMark.size());
  for (unsigned number = 1; !toml.empty(); ++number) {
    auto complaint = complaint_about(base::take_until(toml, "\n"));
    if (!complaint.empty()) return Problem{number, "", std::move(complaint)};
  }
  return std::nullopt;
}

// Depth of the deepest known key: port.NAME.TABLE.KEY.
constexpr std::size_t kMaxDepth = 4;

Value value_of(const toml::array& array) {
  if (!array.empty() && array.is_homogeneous<std::string>()) {
    std::vector<std::string> texts;
    for (const toml::node& element : array) texts.push_back(element.as_string()->get());
    return texts;
  }
  std::vector<double> numbers;
  for (const toml::node& element : array) {
    const auto number = element.value<double>();
    if (!element.is_number() || !number) return Unsupported{"an array"};
    numbers.push_back(*number);
  }
  return numbers;
}

template <class Date>
std::string as_written(const Date& date) {
  std::ostringstream out;
  out << date;
  return out.str();
}

Value value_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table: return Table{};
    case toml::node_type::array: return value_of(*node.as_array());
    case toml::node_type::string: return node.as_string()->get();
    case toml::node_type::integer: return node.as_integer()->get();
    case toml::node_type::floating_point: return node.as_floating_point()->get();
    case toml::node_type::boolean: return node.as_boolean()->get();
    case toml::node_type::date: return as_written(node.as_date()->get());
    default: return Unsupported{"a time"};
  }
}

// Depth of the deepest key that is known, frame[].field[].KEY, and one more, so that what lies there is named.
constexpr std::size_t kMaxTreeDepth = 6;

bool is_list_of_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && !array->empty() && array->is_homogeneous<toml::table>();
}

void grow(const toml::table& table, std::size_t depth, Node& node) {
  if (depth == kMaxTreeDepth) return;
  const std::string prefix = node.name.empty() ? "" : node.name + ".";
  for (const auto& [key, below] : table) {
    Node child{prefix + std::string(key.str()),
               std::string(key.str()),
               static_cast<unsigned>(key.source().begin.line),
               Table{},
               is_list_of_tables(below),
               {}};
    if (child.is_list) {
      std::size_t number = 0;
      for (const toml::node& element : *below.as_array()) {
        Node item{fmt::format("{}[{}]", child.name, ++number),
                  child.key,
                  static_cast<unsigned>(element.source().begin.line),
                  Table{},
                  false,
                  {}};
        grow(*element.as_table(), depth + 1, item);
        child.children.push_back(std::move(item));
      }
    } else if (const toml::table* inner = below.as_table()) {
      grow(*inner, depth + 1, child);
    } else {
      child.value = value_of(below);
    }
    node.children.push_back(std::move(child));
  }
  std::ranges::stable_sort(node.children, {}, &Node::line);
}

/// Adds a value or a table, with what lies in it, to the entries; `keys` are those of the tables around it.
void collect(const Node& node, const std::string& key, std::vector<std::string>& keys,
             std::vector<Entry>& entries) {
  keys.push_back(key);
  entries.push_back({keys, node.is_list ? Value(Unsupported{"an array"}) : node.value, node.line, std::nullopt});
  if (!node.is_list && keys.size() < kMaxDepth) {
    for (const Node& child : node.children) collect(child, child.key, keys, entries);
  }
  keys.pop_back();
}

/// The value of `text` read as TOML, when it is exactly one.
std::optional<Value> one_value(const std::string& text) {
  const std::string line = "v=" + text;
  if (beyond_bounds(line)) return std::nullopt;
  try {
    const toml::table table = toml::parse(line);
    if (table.size() == 1) return value_of(*table.get("v"));
  } catch (const toml::parse_error&) {
    // Not TOML: a text without quotes.
  }
  return std::nullopt;
}

}  // namespace

std::string Entry::name() const { return fmt::format("{}", fmt::join(keys, ".")); }

std::vector<Entry> read_document(std::string_view toml, std::vector<Problem>& problems, std::string_view list) {
  std::vector<Entry> entries;
  std::vector<std::string> keys;
  const Node root = read_tree(toml, problems);
  for (const Node& node : root.children) {
    if (list.empty() || !node.is_list || node.key != list) {
      collect(node, node.key, keys, entries);
      continue;
    }
    for (const Node& table : node.children) collect(table, table.name, keys, entries);
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.line < b.line; });
  return entries;
}

Node read_tree(std::string_view toml, std::vector<Problem>& problems) {
  Node root{{}, {}, 1, Table{}, false, {}};
  if (auto problem = beyond_bounds(toml)) {
    problems.push_back(std::move(*problem));
    return root;
  }
  try {
    grow(toml::parse(toml), 0, root);
  } catch (const toml::parse_error& error) {
    problems.push_back({static_cast<unsigned>(error.source().begin.line), "", std::string(error.description())});
  }
  return root;
}

std::optional<Entry> read_override(std::string_view text, std::vector<Problem>& problems) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    problems.push_back({0, std::string(text), "key=value is expected"});
    return std::nullopt;
  }
  Entry entry;
  std::string_view rest = text.substr(0, equals);
  while (entry.keys.size() <= kMaxDepth) {
    const std::size_t dot = rest.find('.');
    entry.keys.emplace_back(rest.substr(0, dot));
    if (dot == std::string_view::npos) break;
    rest.remove_prefix(dot + 1);
  }
  const std::string given(text.substr(equals + 1));
  // A serial number of digits only is a text, and a path needs no quotes; through TOML, to hold it to the same
  // rules.
  const auto as_text = one_value(to_toml_text(Value(given)));
  if (as_text != Value(given)) {
    problems.push_back({0, entry.name(), "the value is not UTF-8, or too long"});
    return std::nullopt;
  }
  entry.value = one_value(given).value_or(*as_text);
  if (!std::holds_alternative<std::string>(entry.value)) entry.plain_text = std::get<std::string>(*as_text);
  return entry;
}

}  // namespace navcal::config
