// SPDX-License-Identifier: Apache-2.0
#include "config/csv_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "config/complaints.h"
#include "config/described/table_reader.h"
#include "config/document.h"
#include "protocols/decimal.h"
#include "protocols/utc.h"

namespace navcal::config {
namespace {

constexpr std::array<std::string_view, 9> kTimes{"unix_s", "unix_ms", "unix_us", "unix_ns", "s",
                                                 "ms",     "us",      "ns",      "iso8601"};

std::optional<double> number_of(const Value& value) {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

/// Gives the value of a key, where it is stated, to `takes`, which says whether it can be; `complaint` is for one
/// that cannot.
template <class Takes>
void take(TableReader& table, std::string_view key, std::string complaint, Takes takes) {
  const Node* const node = table.find(key);
  if (node == nullptr || takes(node->value)) return;
  table.complain(key, complaint.empty() ? "cannot be " + words_for(node->value) : std::move(complaint));
}

/// Takes a value of one type.
template <class T, class Out>
auto into(Out& out) {
  return [&out](const Value& value) {
    const auto* const given = std::get_if<T>(&value);
    if (given != nullptr) out = *given;
    return given != nullptr;
  };
}

/// Reads a table [column.NAME] of a map.
class ColumnReader {
 public:
  ColumnReader(const Node& node, std::vector<Problem>& problems)
      : node_(node), problems_(problems), table_(node, problems) {}

  /// nullopt for a column that cannot be; the problems say why.
  std::optional<CsvColumn> read() {
    column_.name = node_.key;
    column_.line = node_.line;
    take_keys();
    table_.finish();
    if (!has_meaning_) return table_.has("meaning") ? std::nullopt : complain("meaning is missing");
    const auto quantity = column_.meaning.quantity;
    ColumnUnit unit;
    if (quantity == protocols::described::Meaning::sensor) {
      if (!name_sensor()) return std::nullopt;
    } else if (unit_) {
      const auto found = column_unit(quantity, *unit_);
      if (!found)
        return complain("unit", fmt::format("one of {} is expected", fmt::join(column_units(quantity), ", ")));
      unit = *found;
    }
    if (from_ || to_) return draw_curve(unit);
    column_.factor = scale_.value_or(1) * unit.factor;
    column_.offset = offset_.value_or(0) * unit.factor + unit.offset;
    return column_;
  }

 private:
  void take_keys() {
    std::vector<std::string_view> names;
    for (const ColumnMeaning& meaning : column_meanings()) names.push_back(meaning.name);
    take(table_, "meaning", fmt::format("one of {} is expected", fmt::join(names, ", ")),
         [this](const Value& value) {
           const auto* const text = std::get_if<std::string>(&value);
           const auto* const found = text == nullptr ? nullptr : column_meaning_named(*text);
           has_meaning_ = found != nullptr;
           if (has_meaning_) column_.meaning = *found;
           return has_meaning_;
         });
    take(table_, "unit", "", into<std::string>(unit_));
    take(table_, "quantity", "", into<std::string>(column_.quantity));
    take(table_, "scale", "", [this](const Value& value) { return (scale_ = number_of(value)).value_or(0) != 0; });
    take(table_, "offset", "", [this](const Value& value) { return (offset_ = number_of(value)).has_value(); });
    take(table_, "from", "", into<std::vector<double>>(from_));
    take(table_, "to", "", into<std::vector<double>>(to_));
    take(table_, "instance", "", [this](const Value& value) {
      const auto* const number = std::get_if<std::int64_t>(&value);
      const bool fits = number != nullptr && *number >= 1 && *number <= 9;
      if (fits) column_.instance = static_cast<int>(*number) - 1;
      return fits;
    });
  }

  bool name_sensor() {
    if (column_.quantity.empty()) column_.quantity = column_.name;
    column_.unit = unit_.value_or("");
    // A sample keeps this much of them (instruments/samples.h).
    constexpr std::size_t kLongestQuantity = 24, kLongestUnit = 16;
    if (column_.quantity.size() <= kLongestQuantity && column_.unit.size() <= kLongestUnit) return true;
    complain(fmt::format("quantity has at most {} bytes, unit at most {}", kLongestQuantity, kLongestUnit));
    return false;
  }

  std::optional<CsvColumn> draw_curve(const ColumnUnit& unit) {
    if (!from_ || !to_) return complain(from_ ? "\"from\" needs \"to\"" : "\"to\" needs \"from\"");
    if (scale_ || offset_)
      return complain(offset_ ? "offset" : "scale", "\"from\" and \"to\" take the place of scale and offset");
    if (from_->size() < 2 ||
        std::adjacent_find(from_->begin(), from_->end(), std::greater_equal<>()) != from_->end())
      return complain("from", "two numbers or more are expected, each larger than the one before");
    if (to_->size() != from_->size())
      return complain("to", fmt::format("as many numbers as \"from\" has are expected: {}", from_->size()));
    for (std::size_t i = 0; i < from_->size(); ++i)
      column_.curve.push_back({(*from_)[i], (*to_)[i] * unit.factor + unit.offset});
    return column_;
  }

  /// Notes a problem of the table as a whole.
  std::nullopt_t complain(std::string message) {
    problems_.push_back({node_.line, node_.name, std::move(message)});
    return std::nullopt;
  }
  std::nullopt_t complain(std::string_view key, std::string message) {
    table_.complain(key, std::move(message));
    return std::nullopt;
  }

  const Node& node_;
  std::vector<Problem>& problems_;
  TableReader table_;
  CsvColumn column_;
  bool has_meaning_ = false;
  std::optional<std::string> unit_;
  std::optional<std::vector<double>> from_, to_;
  std::optional<double> scale_, offset_;
};

/// The columns of a map in the order of their names. A map without any is a problem.
std::vector<CsvColumn> read_columns(TableReader& map, std::vector<Problem>& problems) {
  const Node* const tables = map.find("column");
  std::vector<CsvColumn> columns;
  if (tables == nullptr || tables->is_list || tables->children.empty())
    problems.push_back({1, "column", "a map has a [column.NAME] or more"});
  if (tables == nullptr || tables->is_list) return columns;
  for (const Node& table : tables->children) {
    if (auto column = ColumnReader(table, problems).read()) columns.push_back(std::move(*column));
  }
  std::sort(columns.begin(), columns.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return columns;
}

void read_layout(TableReader& file, CsvMap& map) {
  take(file, "delimiter", "one character or \"tab\" is expected", [&](const Value& value) {
    const auto* const text = std::get_if<std::string>(&value);
    const bool is_tab = text != nullptr && *text == "tab";
    if (text == nullptr || (!is_tab && text->size() != 1)) return false;
    map.delimiter = is_tab ? '\t' : text->front();
    return true;
  });
  take(file, "decimal", "\".\" or \",\" is expected", [&](const Value& value) {
    map.decimal_comma = value == Value(std::string(","));
    return map.decimal_comma || value == Value(std::string("."));
  });
  take(file, "comment", "a text is expected", into<std::string>(map.comment));
  take(file, "header", "a line number is expected, 0 for none", [&](const Value& value) {
    const auto* const line = std::get_if<std::int64_t>(&value);
    if (line == nullptr || *line < 0 || *line > 10'000) return false;
    map.header = static_cast<int>(*line);
    return true;
  });
}

void read_time(TableReader& table, CsvMap& map) {
  take(table, "column", "the name of a column is expected, or a list of names", [&](const Value& value) {
    if (const auto* const name = std::get_if<std::string>(&value)) map.time_columns = {*name};
    if (const auto* const names = std::get_if<std::vector<std::string>>(&value)) map.time_columns = *names;
    return !map.time_columns.empty();
  });
  if (const auto text = table.text("format")) {
    const auto found = std::find(kTimes.begin(), kTimes.end(), *text);
    if (found != kTimes.end()) {
      map.time = static_cast<CsvTime>(found - kTimes.begin());
    } else if (text->find('%') != std::string::npos) {
      map.time = CsvTime::pattern;
      map.pattern = *text;
    } else {
      table.complain("format", fmt::format("one of {} is expected, or a pattern such as \"%d/%m/%Y %H:%M:%S\"",
                                           fmt::join(kTimes, ", ")));
    }
  }
  take(table, "start", "a time such as \"2024-05-01T12:00:00Z\" is expected", [&](const Value& value) {
    const auto* const text = std::get_if<std::string>(&value);
    map.start_ns = text == nullptr ? std::nullopt : parse_iso_time(*text);
    return map.start_ns.has_value();
  });
  table.finish();
}

std::optional<std::uint8_t> two_digits(std::string_view text, std::size_t first) {
  return text.size() < first + 2 ? std::nullopt : protocols::integer<std::uint8_t>(text.substr(first, 2));
}

/// Nanoseconds of ".25" at the front of `text`, which it takes away.
std::uint32_t take_fraction(std::string_view& text) {
  if (!text.starts_with('.') && !text.starts_with(',')) return 0;
  text.remove_prefix(1);
  std::uint32_t ns = 0;
  for (int i = 0; i < 9; ++i) {
    const bool has_digit = !text.empty() && text.front() >= '0' && text.front() <= '9';
    ns = ns * 10 + (has_digit ? static_cast<std::uint32_t>(text.front() - '0') : 0);
    if (has_digit) text.remove_prefix(1);
  }
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') text.remove_prefix(1);
  return ns;
}

std::optional<std::int64_t> zone_ns(std::string_view text) {
  if (text.empty() || text == "Z") return 0;
  const auto hours = two_digits(text, 1), minutes = two_digits(text, text.size() == 6 ? 4 : 3);
  const bool has_sign = text.front() == '+' || text.front() == '-';
  const bool fits = (text.size() == 6 && text[3] == ':') || text.size() == 5;
  if (!has_sign || !fits || !hours || !minutes) return std::nullopt;
  constexpr std::int64_t kMinute_ns = 60'000'000'000;
  return (*hours * 60 + *minutes) * kMinute_ns * (text.front() == '-' ? -1 : 1);
}

}  // namespace

double CsvColumn::value(double number) const {
  if (curve.empty()) return number * factor + offset;
  if (number <= curve.front().from) return curve.front().to;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const CurvePoint &before = curve[i - 1], &after = curve[i];
    if (number <= after.from)
      return std::lerp(before.to, after.to, (number - before.from) / (after.from - before.from));
  }
  return curve.back().to;
}

bool CsvColumn::is_beyond(double number) const {
  return !curve.empty() && (number < curve.front().from || number > curve.back().from);
}

std::optional<std::int64_t> parse_iso_time(std::string_view text) {
  constexpr std::size_t kSeconds_end = 19;
  const auto date = text.size() < kSeconds_end ? std::nullopt : protocols::parse_iso_date(text.substr(0, 10));
  if (!date || (text[10] != 'T' && text[10] != ' ') || text[13] != ':' || text[16] != ':') return std::nullopt;
  const auto hour = two_digits(text, 11), minute = two_digits(text, 14), second = two_digits(text, 17);
  if (!hour || !minute || !second) return std::nullopt;
  std::string_view rest = text.substr(kSeconds_end);
  const protocols::TimeOfDay time{*hour, *minute, *second, take_fraction(rest)};
  const auto zone = zone_ns(rest);
  if (!is_valid(time) || !zone) return std::nullopt;
  return unix_ns(*date, time) - *zone;
}

CsvMap parse_csv_map(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  const Node root = read_tree(toml, problems);
  refuse(problems, name);
  CsvMap map;
  TableReader file(root, problems);
  read_layout(file, map);
  if (const Node* const time = file.find("time")) {
    TableReader table(*time, problems);
    read_time(table, map);
  }
  if (map.time_columns.empty()) problems.push_back({1, "time.column", "is missing"});
  map.columns = read_columns(file, problems);
  file.finish();
  refuse(std::move(problems), name);
  return map;
}

ChannelMap parse_channel_map(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  const Node root = read_tree(toml, problems);
  refuse(problems, name);
  TableReader file(root, problems);
  const auto pass_over = [&](const Node& node) {
    problems.push_back(
        {node.line, node.name, "only tables [column.NAME] are known: the log says the rest itself"});
  };
  for (const Node& child : root.children) {
    if (child.key == "column") continue;
    pass_over(child);
    for (const Node& below : child.children) pass_over(below);
  }
  ChannelMap map{std::string(name), read_columns(file, problems)};
  std::vector<std::string_view> motor_names;
  for (const ColumnMeaning& meaning : column_meanings()) {
    if (meaning.is_motor()) motor_names.push_back(meaning.name);
  }
  for (const CsvColumn& channel : map.channels) {
    if (channel.meaning.is_motor()) continue;
    problems.push_back({channel.line, "column." + channel.name + ".meaning",
                        fmt::format("one of {} is expected", fmt::join(motor_names, ", "))});
  }
  refuse(std::move(problems), name);
  return map;
}

ChannelMap load_channel_map(const std::filesystem::path& file) {
  return parse_channel_map(content_of(file), file.string());
}

CsvMap load_csv_map(const std::filesystem::path& file) { return parse_csv_map(content_of(file), file.string()); }

}  // namespace navcal::config
