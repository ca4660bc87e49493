// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/dataflash_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/line_reader.h"

namespace navcal::analysis::dataflash {
namespace {

constexpr std::uint8_t kFormatType = 128;

enum class Number : std::uint8_t { none, whole, natural, real };

/// Field of a format character.
struct Format {
  std::size_t bytes = 0;  ///< 0: the character is unknown
  Number number = Number::none;
  double factor = 1;  ///< that the character itself implies, in a log without multipliers
};

constexpr std::array<Format, 256> kFormats = [] {
  using enum Number;
  constexpr std::pair<char, Format> kKnown[] = {{'b', {1, whole}},
                                                {'B', {1, natural}},
                                                {'M', {1, natural}},
                                                {'h', {2, whole}},
                                                {'H', {2, natural}},
                                                {'c', {2, whole, 1e-2}},
                                                {'C', {2, natural, 1e-2}},
                                                {'g', {2}},
                                                {'i', {4, whole}},
                                                {'I', {4, natural}},
                                                {'e', {4, whole, 1e-2}},
                                                {'E', {4, natural, 1e-2}},
                                                {'L', {4, whole, 1e-7}},
                                                {'f', {4, real}},
                                                {'n', {4}},
                                                {'d', {8, real}},
                                                {'q', {8, whole}},
                                                {'Q', {8, natural}},
                                                {'N', {16}},
                                                {'Z', {64}},
                                                {'a', {64}}};
  std::array<Format, 256> formats{};
  for (const auto& [letter, format] : kKnown) formats[static_cast<std::uint8_t>(letter)] = format;
  return formats;
}();

const Format& format_of(char letter) { return kFormats[static_cast<std::uint8_t>(letter)]; }

template <class T>
T little_endian(std::string_view record, std::size_t offset) {
  T value{};
  std::memcpy(&value, record.data() + offset, sizeof value);
  return value;
}

std::string_view until_zero(std::string_view text) {
  return text.substr(0, std::min(text.find('\0'), text.size()));
}

}  // namespace

const Column* MessageType::find(std::string_view column) const {
  const auto found = std::ranges::find_if(columns, [&](const Column& c) { return c.name == column; });
  return found == columns.end() ? nullptr : &*found;
}

const Column* MessageType::instance() const {
  for (const std::string_view one : {"I", "Instance", "Inst"})
    if (const Column* const column = find(one); column != nullptr) return column;
  return nullptr;
}

std::optional<std::int64_t> integer_of(const Column& column, std::string_view record) {
  const Format& format = format_of(column.format);
  if (format.number != Number::whole && format.number != Number::natural) return std::nullopt;
  std::uint64_t bits = 0;
  std::memcpy(&bits, record.data() + column.offset, format.bytes);
  const std::size_t unused = 64 - 8 * format.bytes;
  if (format.number == Number::whole) return static_cast<std::int64_t>(bits << unused) >> unused;
  return bits > INT64_MAX ? std::nullopt : std::optional(static_cast<std::int64_t>(bits));
}

std::string_view text_of(const Column& column, std::string_view record) {
  if (std::string_view("nNZ").find(column.format) == std::string_view::npos) return {};
  return until_zero(record.substr(column.offset, format_of(column.format).bytes));
}

// FMT describes itself as every other message; a log that does not is read by this.
Table::Table() {
  MessageType& format = types_[kFormatType];
  format.name = "FMT";
  format.length = 89;
  format.columns = {
      {"Type", 'B', 3}, {"Length", 'B', 4}, {"Name", 'n', 5}, {"Format", 'N', 9}, {"Columns", 'Z', 25}};
}

bool Table::learn(std::uint8_t type, std::string_view record) {
  const MessageType& message = types_[type];
  const auto character = [&](std::string_view column) {
    const Column* const found = message.find(column);
    const auto value = found == nullptr ? std::nullopt : integer_of(*found, record);
    return value ? std::optional(static_cast<char>(*value)) : std::nullopt;
  };
  if (type == kFormatType) {
    learn_format(record);
  } else if (message.name == "FMTU") {
    learn_units(record);
  } else if (message.name == "UNIT") {
    const Column* const label = message.find("Label");
    if (const auto id = character("Id"); id && label != nullptr) units_[*id] = text_of(*label, record);
  } else if (message.name == "MULT") {
    const Column* const factor = message.find("Mult");
    const auto id = character("Id");
    if (id && factor != nullptr && factor->format == 'd')
      multipliers_[*id] = little_endian<double>(record, factor->offset);
  } else {
    return false;
  }
  ++version_;
  return true;
}

void Table::learn_format(std::string_view record) {
  const auto type = static_cast<std::uint8_t>(record[3]);
  if (type == kFormatType) return;
  MessageType message;
  message.length = static_cast<std::uint8_t>(record[4]);
  message.name = until_zero(record.substr(5, 4));
  const std::string_view formats = until_zero(record.substr(9, 16));
  std::string_view names = until_zero(record.substr(25, 64));
  std::size_t offset = kHead_bytes;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::size_t size = format_of(formats[i]).bytes;
    if (size == 0) return;
    if (!names.empty()) message.columns.push_back({std::string(base::take_until(names, ",")), formats[i], offset});
    offset += size;
  }
  if (offset != message.length) return;
  types_[type] = std::move(message);
}

void Table::learn_units(std::string_view record) {
  const MessageType& own = types_[static_cast<std::uint8_t>(record[2])];
  const Column* const type = own.find("FmtType");
  const Column* const units = own.find("UnitIds");
  const Column* const multipliers = own.find("MultIds");
  if (type == nullptr || units == nullptr || multipliers == nullptr) return;
  const auto number = integer_of(*type, record);
  if (!number || *number < 0 || *number > 255) return;
  const std::string_view unit_ids = text_of(*units, record), multiplier_ids = text_of(*multipliers, record);
  auto& columns = types_[static_cast<std::size_t>(*number)].columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i < unit_ids.size()) columns[i].unit = unit_ids[i];
    if (i < multiplier_ids.size()) columns[i].multiplier = multiplier_ids[i];
  }
}

std::optional<double> Table::value(const Column& column, std::string_view record) const {
  double value = 0;
  if (column.format == 'f') {
    value = static_cast<double>(little_endian<float>(record, column.offset));
  } else if (column.format == 'd') {
    value = little_endian<double>(record, column.offset);
  } else if (const auto integer = integer_of(column, record)) {
    value = static_cast<double>(*integer);
  } else {
    return std::nullopt;
  }
  const auto stated = multipliers_.find(column.multiplier);
  // "-" (0) means that there is none, "?" (1) that it is not known.
  const bool has_factor = stated != multipliers_.end() && stated->second != 0 && column.multiplier != '?';
  return value * (has_factor ? stated->second : format_of(column.format).factor);
}

std::string_view Table::unit(const Column& column) const {
  const auto stated = units_.find(column.unit);
  if (stated == units_.end() || column.unit == '-' || column.unit == '?') return {};
  return stated->second;
}

}  // namespace navcal::analysis::dataflash
