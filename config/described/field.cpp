// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/line_reader.h"
#include "config/column_meaning.h"
#include "config/complaints.h"
#include "config/described/description_file.h"
#include "config/described/parts.h"
#include "config/text_rules.h"
#include "protocols/decimal.h"

namespace navcal::config {
namespace {

using protocols::described::Dimension;
using protocols::described::Field;
using protocols::described::Meaning;
using protocols::described::Type;

constexpr double kLargest = 1e15;
constexpr std::size_t kLongestName = 23;  // of a quantity in ScalarSample
constexpr std::size_t kLongestUnit = 15;  // likewise
constexpr int kLastField = 128;           // as protocols/described/text.h

bool is_field_name(std::string_view text) {
  return !text.empty() && text.size() <= kLongestName && is_identifier_or_nothing(text);
}

std::vector<std::string> meaning_names() {
  std::vector<std::string> names;
  for (std::size_t i = 2; i < protocols::described::kMeaningCount; ++i)  // without none and sensor
    names.emplace_back(info_of(static_cast<Meaning>(i)).name);
  for (const ColumnMeaning& column : column_meanings()) {
    if (column.quantity != Meaning::sensor) names.emplace_back(column.name);
  }
  return names;
}

std::vector<std::string> units_of(Dimension dimension) {
  std::vector<std::string> names;
  for (const auto& unit : protocols::described::all_units()) {
    if (unit.dimension == dimension) names.emplace_back(unit.name);
  }
  return names;
}

/// name, meaning and sensor: at least one says what the number is.
void read_meaning(TableReader& table, Field& field) {
  const auto own = table.text("name");
  if (own && !is_field_name(*own))
    table.complain(
        "name", fmt::format("{} is not 1 to {} of a-z, A-Z, 0-9, _, . and -", to_toml_text(*own), kLongestName));
  if (const auto word = table.choice("meaning", meaning_names())) {
    const auto* const column = column_meaning_named(*word);
    field.meaning = protocols::described::meaning_named(*word).value_or(column ? column->quantity : Meaning::none);
  }
  const auto sensor = table.text("sensor");
  if (sensor) {
    if (table.has("meaning")) table.complain("sensor", "only one of meaning and sensor may be given");
    if (own) table.complain("sensor", "only one of name and sensor may be given");
    if (!is_field_name(*sensor))
      table.complain("sensor", fmt::format("{} is not 1 to {} of a-z, A-Z, 0-9, _, . and -", to_toml_text(*sensor),
                                           kLongestName));
    field.meaning = Meaning::sensor;
  }
  if (!own && !sensor && !table.has("meaning"))
    table.complain("name", "missing; a field has a meaning, a sensor or a name");
  field.name = own ? *own : sensor ? *sensor : std::string(info_of(field.meaning).name);
}

void read_unit(TableReader& table, Field& field) {
  const auto given = table.text("unit");
  const Dimension wanted = info_of(field.meaning).dimension;
  if (wanted == Dimension::any) {  // shown as it is
    if (given) field.unit = *given;
    if (field.unit.size() > kLongestUnit)
      table.complain("unit", fmt::format("a unit has at most {} characters", kLongestUnit));
    return;
  }
  if (!given) {
    const auto known = units_of(wanted);
    if (wanted != Dimension::number && !table.has("unit"))
      table.complain("unit",
                     fmt::format("missing; {} is in {}", info_of(field.meaning).name, fmt::join(known, ", ")));
    return;
  }
  const auto* unit = protocols::described::unit_named(*given);
  if (unit == nullptr || unit->dimension != wanted) {
    const auto known = units_of(wanted);
    const std::string guess = suggestion(*given, known);
    table.complain(
        "unit", fmt::format("{} is no unit of {}; known: {}{}", to_toml_text(*given), info_of(field.meaning).name,
                            fmt::join(known, ", "), unit == nullptr ? guess : ""));
    return;
  }
  field.unit = *given;
  field.factor = unit->factor;
  field.offset = unit->offset;
}

void read_bits(TableReader& table, Field& field) {
  const bool is_unsigned =
      field.type == Type::u8 || field.type == Type::u16 || field.type == Type::u24 || field.type == Type::u32;
  const char* const key = table.has("bit") ? "bit" : "bits";
  if (!table.has("bit") && !table.has("bits")) return;
  if (table.has("bit") && table.has("bits")) table.complain("bits", "only one of bit and bits may be given");
  if (!is_unsigned) {
    table.complain(key, fmt::format("bits are of u8, u16, u24 or u32, not of {}", name_of(field.type)));
    return;
  }
  const int last = static_cast<int>(8 * size_of(field.type)) - 1;
  std::optional<std::pair<int, int>> range;
  if (const auto bit = table.whole("bit", 0, last))
    range = std::pair(static_cast<int>(*bit), static_cast<int>(*bit));
  if (const auto bits = table.pair("bits", 0, last)) range = bits;
  if (!range) return;
  if (range->first > range->second) {
    table.complain(key, "the first bit is beyond the last one");
    return;
  }
  field.first_bit = static_cast<std::uint8_t>(range->first);
  field.bits = static_cast<std::uint8_t>(range->second - range->first + 1);
}

void read_place(TableReader& table, Field& field, const described::Defaults& defaults) {
  std::vector<std::string> types;
  for (const Type type : {Type::u8, Type::i8, Type::u16, Type::i16, Type::u24, Type::i24, Type::u32, Type::i32,
                          Type::f32, Type::f64, Type::decimal, Type::hex, Type::degrees_minutes, Type::nmea}) {
    if ((size_of(type) == 0) == defaults.is_text) types.emplace_back(name_of(type));
  }
  field.type = defaults.is_text ? Type::decimal : Type::u8;
  if (const auto type = table.choice("type", types))
    field.type = protocols::described::type_named(*type).value_or(field.type);
  field.byte_order = defaults.byte_order;
  if (!defaults.is_text) {
    table.require("type", fmt::format("known: {}", fmt::join(types, ", ")));
    table.require("at", "the offset of its first byte in the frame, from 0");
    if (const auto at = table.whole("at", 0, protocols::described::kMaxFrameLength - 1))
      field.at = static_cast<std::uint16_t>(*at);
    described::Defaults own = defaults;
    described::take_defaults(table, own);
    field.byte_order = own.byte_order;
    read_bits(table, field);
    return;
  }
  if (const auto number = table.whole("number", 1, kLastField)) field.at = static_cast<std::uint16_t>(*number);
  if (const auto key = table.text("key")) field.key = *key;
  if (table.has("number") == table.has("key"))
    table.complain("number", table.has("key") ? "only one of number and key may be given"
                                              : "missing; a field of a text has a number, from 1, or a key");
  if (table.has("key") && field.key.empty()) table.complain("key", "a key has a character or more");
  if (const auto number = table.whole("sign_number", 1, kLastField))
    field.sign_at = static_cast<std::uint16_t>(*number);
}

void read_scale(TableReader& table, Field& field) {
  const auto not_zero = [&](std::string_view key, double& value) {
    const auto given = table.number(key, -kLargest, kLargest);
    if (!given) return;
    if (*given == 0)
      table.complain(key, "0 is not taken: the value is (raw * scale - zero) / sensitivity");
    else
      value = *given;
  };
  not_zero("scale", field.scale);
  not_zero("sensitivity", field.sensitivity);
  if (const auto zero = table.number("zero", -kLargest, kLargest)) field.zero = *zero;
  field.absent = table.number("absent", -kLargest, kLargest);
  field.low = table.number("low", -kLargest, kLargest, field.unit);
  field.high = table.number("high", -kLargest, kLargest, field.unit);
  if (field.low && field.high && *field.low > *field.high)
    table.complain("low", fmt::format("{} is more than high, {}", *field.low, *field.high));
  if (const auto std = table.number("std", 0, kLargest, field.unit)) field.std = *std * field.factor;
}

std::optional<std::string> set_constant(Field& field, std::string_view key, double number) {
  if (key == "zero") {
    field.zero = number;
  } else if (key == "scale" || key == "sensitivity") {
    if (number == 0) return fmt::format("{} is not 0", key);
    (key == "scale" ? field.scale : field.sensitivity) = number;
  } else {
    return fmt::format("unknown key {}; known: zero, scale, sensitivity", to_toml_text(std::string(key)));
  }
  return std::nullopt;
}

}  // namespace

protocols::described::Field described::read_field(const Node& node, const Defaults& defaults,
                                                  std::vector<Problem>& problems) {
  Field field;
  TableReader table(node, problems);
  read_meaning(table, field);
  read_unit(table, field);
  read_place(table, field, defaults);
  read_scale(table, field);
  table.finish();
  return field;
}

std::optional<std::string> adjust(protocols::described::Description& description, std::string_view adjustment) {
  const std::string name(base::trimmed(base::take_until(adjustment, ":")));
  std::vector<Field*> fields;
  std::vector<std::string> names;
  for (auto& kind : description.kinds) {
    for (Field& field : kind.fields) {
      names.push_back(field.name);
      if (field.name == name) fields.push_back(&field);
    }
  }
  if (fields.empty())
    return fmt::format("the description has no field {}", to_toml_text(name)) + suggestion(name, names);
  if (base::trimmed(adjustment).empty())
    return fmt::format("{} lacks what is to be changed, such as \"{}: zero = 1\"", to_toml_text(name), name);
  while (!adjustment.empty()) {
    std::string_view part = base::take_until(adjustment, ",");
    const std::string_view key = base::trimmed(base::take_until(part, "="));
    part = base::trimmed(part);
    const auto number = protocols::real(part);
    if (!number || !(std::abs(*number) <= kLargest))
      return fmt::format("{} is no number", to_toml_text(std::string(part)));
    for (Field* field : fields) {
      if (auto wrong = set_constant(*field, key, *number)) return wrong;
    }
  }
  return std::nullopt;
}

}  // namespace navcal::config
