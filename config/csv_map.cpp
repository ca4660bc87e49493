// SPDX-License-Identifier: Apache-2.0
#include "config/csv_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "config/complaints.h"
#include "config/document.h"
#include "config/suggestion.h"
#include "protocols/utc.h"

namespace navcal::config {
namespace {

constexpr std::array<std::string_view, 9> kTimes{"unix_s", "unix_ms", "unix_us", "unix_ns", "s",
                                                 "ms",     "us",      "ns",      "iso8601"};

template <class T>
const T* value_as(const Entry& entry) {
  return std::get_if<T>(&entry.value);
}

std::optional<double> number_of(const Entry& entry) {
  if (const auto* real = std::get_if<double>(&entry.value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&entry.value)) return static_cast<double>(*whole);
  return std::nullopt;
}

const std::vector<double>& numbers_of(const Entry& entry) { return std::get<std::vector<double>>(entry.value); }

/// Reads the tables [column.NAME] of a map, entry by entry.
class ColumnReader {
 public:
  explicit ColumnReader(std::vector<Problem>& problems) : problems_(problems) {}

  /// An entry whose first key is "column".
  void take(const Entry& entry) {
    if (entry.keys.size() == 1) return;
    Given& given = columns_[entry.keys[1]];
    if (entry.keys.size() == 2) {
      given.table = entry;
    } else {
      take_key(given, entry);
    }
  }

  /// The columns in the order of their names. A map without any is a problem.
  std::vector<CsvColumn> finish() {
    if (columns_.empty()) problems_.push_back({1, "column", "a map has a [column.NAME] or more"});
    std::vector<CsvColumn> columns;
    for (auto& [name, given] : columns_) finish_column(name, given, columns);
    return columns;
  }

 private:
  struct Given {
    Entry table;
    CsvColumn column;
    bool has_meaning = false;
    std::optional<Entry> unit, line, from, to;  ///< line: scale or offset, the last of them
    double scale = 1;
    double offset = 0;
  };

  void take_key(Given& given, const Entry& entry) {
    const std::string& key = entry.keys[2];
    const auto* text = std::get_if<std::string>(&entry.value);
    const auto number = number_of(entry);
    const bool is_list = std::holds_alternative<std::vector<double>>(entry.value);
    if (key == "meaning") {
      const auto* const found = text == nullptr ? nullptr : column_meaning_named(*text);
      if (found == nullptr) {
        std::vector<std::string_view> names;
        for (const ColumnMeaning& meaning : column_meanings()) names.push_back(meaning.name);
        return complain(entry, fmt::format("one of {} is expected", fmt::join(names, ", ")));
      }
      given.column.meaning = *found;
      given.has_meaning = true;
    } else if (key == "unit" && text != nullptr) {
      given.unit = entry;
    } else if (key == "quantity" && text != nullptr) {
      given.column.quantity = *text;
    } else if (key == "scale" && number && *number != 0) {
      given.scale = *number;
      given.line = entry;
    } else if (key == "offset" && number) {
      given.offset = *number;
      given.line = entry;
    } else if (key == "from" && is_list) {
      given.from = entry;
    } else if (key == "to" && is_list) {
      given.to = entry;
    } else if (key == "instance" && std::holds_alternative<std::int64_t>(entry.value) && *number >= 1 &&
               *number <= 9) {
      given.column.instance = static_cast<int>(*number) - 1;
    } else {
      const std::vector<std::string> known{"meaning", "unit", "quantity", "scale",
                                           "offset",  "from", "to",       "instance"};
      const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
      complain(entry, is_known ? "cannot be " + words_for(entry.value) : "unknown key" + suggestion(key, known));
    }
  }

  void finish_column(const std::string& name, Given& given, std::vector<CsvColumn>& columns) {
    if (given.table.keys.empty()) given.table.keys = {"column", name};
    if (!given.has_meaning) return complain(given.table, "meaning is missing");
    const auto quantity = given.column.meaning.quantity;
    CsvColumn column = given.column;
    column.name = name;
    column.line = given.table.line;
    ColumnUnit unit;
    if (quantity == protocols::described::Meaning::sensor) {
      if (!name_sensor(column, given)) return;
    } else if (given.unit) {
      const auto found = column_unit(quantity, std::get<std::string>(given.unit->value));
      if (!found)
        return complain(*given.unit,
                        fmt::format("one of {} is expected", fmt::join(column_units(quantity), ", ")));
      unit = *found;
    }
    if (given.from || given.to) {
      if (!draw_curve(column, given, unit)) return;
    } else {
      column.factor = given.scale * unit.factor;
      column.offset = given.offset * unit.factor + unit.offset;
    }
    columns.push_back(std::move(column));
  }

  bool name_sensor(CsvColumn& column, const Given& given) {
    if (column.quantity.empty()) column.quantity = column.name;
    if (given.unit) column.unit = std::get<std::string>(given.unit->value);
    // A sample keeps this much of them (instruments/samples.h).
    constexpr std::size_t kLongestQuantity = 24, kLongestUnit = 16;
    if (column.quantity.size() <= kLongestQuantity && column.unit.size() <= kLongestUnit) return true;
    complain(given.table,
             fmt::format("quantity has at most {} bytes, unit at most {}", kLongestQuantity, kLongestUnit));
    return false;
  }

  bool draw_curve(CsvColumn& column, const Given& given, const ColumnUnit& unit) {
    if (!given.from || !given.to) {
      complain(given.table, given.from ? "\"from\" needs \"to\"" : "\"to\" needs \"from\"");
      return false;
    }
    if (given.line) {
      complain(*given.line, "\"from\" and \"to\" take the place of scale and offset");
      return false;
    }
    const auto& from = numbers_of(*given.from);
    const auto& to = numbers_of(*given.to);
    if (from.size() < 2 || std::adjacent_find(from.begin(), from.end(), std::greater_equal<>()) != from.end()) {
      complain(*given.from, "two numbers or more are expected, each larger than the one before");
      return false;
    }
    if (to.size() != from.size()) {
      complain(*given.to, fmt::format("as many numbers as \"from\" has are expected: {}", from.size()));
      return false;
    }
    for (std::size_t i = 0; i < from.size(); ++i)
      column.curve.push_back({from[i], to[i] * unit.factor + unit.offset});
    return true;
  }

  void complain(const Entry& entry, std::string message) {
    problems_.push_back({entry.line, entry.name(), std::move(message)});
  }

  std::vector<Problem>& problems_;
  std::map<std::string, Given> columns_;
};

/// Reads the entries of a map one after the other.
class MapReader {
 public:
  explicit MapReader(std::vector<Problem>& problems) : problems_(problems), columns_(problems) {}

  void take(const Entry& entry) {
    const std::string& head = entry.keys.front();
    if (head == "time") return take_time(entry);
    if (head == "column") return columns_.take(entry);
    if (entry.keys.size() > 1 || value_as<Table>(entry) != nullptr)
      return complain(entry, "unknown table; known: time, column");
    take_layout(entry);
  }

  CsvMap finish() {
    if (map_.time_columns.empty()) problems_.push_back({1, "time.column", "is missing"});
    map_.columns = columns_.finish();
    return std::move(map_);
  }

 private:
  void take_layout(const Entry& entry) {
    const std::string& key = entry.keys.front();
    const auto* text = value_as<std::string>(entry);
    if (key == "delimiter") {
      if (text != nullptr && *text == "tab") {
        map_.delimiter = '\t';
      } else if (text != nullptr && text->size() == 1) {
        map_.delimiter = text->front();
      } else {
        complain(entry, "one character or \"tab\" is expected");
      }
    } else if (key == "decimal") {
      if (text == nullptr || (*text != "." && *text != ",")) return complain(entry, "\".\" or \",\" is expected");
      map_.decimal_comma = *text == ",";
    } else if (key == "comment") {
      if (text == nullptr) return complain(entry, "a text is expected");
      map_.comment = *text;
    } else if (key == "header") {
      const auto* line = value_as<std::int64_t>(entry);
      if (line == nullptr || *line < 0 || *line > 10'000)
        return complain(entry, "a line number is expected, 0 for none");
      map_.header = static_cast<int>(*line);
    } else {
      complain(entry, "unknown key" + suggestion(key, {"delimiter", "decimal", "comment", "header"}));
    }
  }

  void take_time(const Entry& entry) {
    if (entry.keys.size() == 1) return;
    const std::string& key = entry.keys[1];
    const auto* text = value_as<std::string>(entry);
    if (key == "column") {
      if (text != nullptr) {
        map_.time_columns = {*text};
      } else if (const auto* names = value_as<std::vector<std::string>>(entry);
                 names != nullptr && !names->empty()) {
        map_.time_columns = *names;
      } else {
        complain(entry, "the name of a column is expected, or a list of names");
      }
    } else if (key == "format") {
      if (text == nullptr) return complain(entry, "a text is expected");
      const auto found = std::find(kTimes.begin(), kTimes.end(), *text);
      if (found != kTimes.end()) {
        map_.time = static_cast<CsvTime>(found - kTimes.begin());
      } else if (text->find('%') != std::string::npos) {
        map_.time = CsvTime::pattern;
        map_.pattern = *text;
      } else {
        complain(entry, fmt::format("one of {} is expected, or a pattern such as \"%d/%m/%Y %H:%M:%S\"",
                                    fmt::join(kTimes, ", ")));
      }
    } else if (key == "start") {
      map_.start_ns = text == nullptr ? std::nullopt : parse_iso_time(*text);
      if (!map_.start_ns) complain(entry, "a time such as \"2024-05-01T12:00:00Z\" is expected");
    } else {
      complain(entry, "unknown key" + suggestion(key, {"column", "format", "start"}));
    }
  }

  void complain(const Entry& entry, std::string message) {
    problems_.push_back({entry.line, entry.name(), std::move(message)});
  }

  std::vector<Problem>& problems_;
  CsvMap map_;
  ColumnReader columns_;
};

std::optional<int> digits(std::string_view text, std::size_t first, std::size_t count) {
  if (text.size() < first + count) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(first, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
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
  const auto hours = digits(text, 1, 2), minutes = digits(text, text.size() == 6 ? 4 : 3, 2);
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
  const auto hour = digits(text, 11, 2), minute = digits(text, 14, 2), second = digits(text, 17, 2);
  if (!hour || !minute || !second) return std::nullopt;
  std::string_view rest = text.substr(kSeconds_end);
  const protocols::TimeOfDay time{static_cast<std::uint8_t>(*hour), static_cast<std::uint8_t>(*minute),
                                  static_cast<std::uint8_t>(*second), take_fraction(rest)};
  const auto zone = zone_ns(rest);
  if (!is_valid(time) || !zone) return std::nullopt;
  return unix_ns(*date, time) - *zone;
}

CsvMap parse_csv_map(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  const auto entries = read_document(toml, problems);
  if (!problems.empty()) refuse(problems, name);
  MapReader reader(problems);
  for (const Entry& entry : entries) reader.take(entry);
  CsvMap map = reader.finish();
  refuse(std::move(problems), name);
  return map;
}

ChannelMap parse_channel_map(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  const auto entries = read_document(toml, problems);
  if (!problems.empty()) refuse(problems, name);
  ColumnReader reader(problems);
  for (const Entry& entry : entries) {
    if (entry.keys.front() == "column") {
      reader.take(entry);
    } else {
      problems.push_back(
          {entry.line, entry.name(), "only tables [column.NAME] are known: the log says the rest itself"});
    }
  }
  ChannelMap map{std::string(name), reader.finish()};
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
