// SPDX-License-Identifier: Apache-2.0
#include "config/column_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "config/suggestion.h"

namespace navcal::config {
namespace {

std::optional<double> number_of(const Entry& entry) {
  if (const auto* real = std::get_if<double>(&entry.value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&entry.value)) return static_cast<double>(*whole);
  return std::nullopt;
}

const std::vector<double>& numbers_of(const Entry& entry) { return std::get<std::vector<double>>(entry.value); }

}  // namespace

void ColumnReader::take(const Entry& entry) {
  if (entry.keys.size() == 1) return;
  Given& given = columns_[entry.keys[1]];
  if (entry.keys.size() == 2) {
    given.table = entry;
  } else {
    take_key(given, entry);
  }
}

void ColumnReader::take_key(Given& given, const Entry& entry) {
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

std::vector<CsvColumn> ColumnReader::finish() {
  if (columns_.empty()) problems_.push_back({1, "column", "a map has a [column.NAME] or more"});
  std::vector<CsvColumn> columns;
  for (auto& [name, given] : columns_) finish_column(name, given, columns);
  return columns;
}

void ColumnReader::finish_column(const std::string& name, Given& given, std::vector<CsvColumn>& columns) {
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
      return complain(*given.unit, fmt::format("one of {} is expected", fmt::join(column_units(quantity), ", ")));
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

bool ColumnReader::name_sensor(CsvColumn& column, const Given& given) {
  if (column.quantity.empty()) column.quantity = column.name;
  if (given.unit) column.unit = std::get<std::string>(given.unit->value);
  // A sample keeps this much of them (instruments/samples.h).
  constexpr std::size_t kLongestQuantity = 24, kLongestUnit = 16;
  if (column.quantity.size() <= kLongestQuantity && column.unit.size() <= kLongestUnit) return true;
  complain(given.table,
           fmt::format("quantity has at most {} bytes, unit at most {}", kLongestQuantity, kLongestUnit));
  return false;
}

bool ColumnReader::draw_curve(CsvColumn& column, const Given& given, const ColumnUnit& unit) {
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

void ColumnReader::complain(const Entry& entry, std::string message) {
  problems_.push_back({entry.line, entry.name(), std::move(message)});
}

}  // namespace navcal::config
