// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/dataflash_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navcal::analysis::dataflash {
namespace {

constexpr std::uint8_t kFormatType = 128;

/// Bytes of a field by its format character; 0 for an unknown one.
std::size_t size_of(char format) {
  switch (format) {
    case 'b':
    case 'B':
    case 'M': return 1;
    case 'h':
    case 'H':
    case 'c':
    case 'C':
    case 'g': return 2;
    case 'i':
    case 'I':
    case 'e':
    case 'E':
    case 'L':
    case 'f':
    case 'n': return 4;
    case 'd':
    case 'q':
    case 'Q': return 8;
    case 'N': return 16;
    case 'Z':
    case 'a': return 64;
    default: return 0;
  }
}

template <class T>
T little_endian(std::string_view record, std::size_t offset) {
  T value{};
  std::memcpy(&value, record.data() + offset, sizeof value);
  return value;
}

/// The factor that a format character itself implies, in a log without multipliers.
double implied_factor(char format) {
  switch (format) {
    case 'c':
    case 'C':
    case 'e':
    case 'E': return 1e-2;
    case 'L': return 1e-7;
    default: return 1;
  }
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return parts;
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
  switch (column.format) {
    case 'b': return little_endian<std::int8_t>(record, column.offset);
    case 'B':
    case 'M': return little_endian<std::uint8_t>(record, column.offset);
    case 'h':
    case 'c': return little_endian<std::int16_t>(record, column.offset);
    case 'H':
    case 'C': return little_endian<std::uint16_t>(record, column.offset);
    case 'i':
    case 'e':
    case 'L': return little_endian<std::int32_t>(record, column.offset);
    case 'I':
    case 'E': return little_endian<std::uint32_t>(record, column.offset);
    case 'q': return little_endian<std::int64_t>(record, column.offset);
    case 'Q': {
      const auto value = little_endian<std::uint64_t>(record, column.offset);
      return value > INT64_MAX ? std::nullopt : std::optional(static_cast<std::int64_t>(value));
    }
    default: return std::nullopt;
  }
}

std::string_view text_of(const Column& column, std::string_view record) {
  if (std::string_view("nNZ").find(column.format) == std::string_view::npos) return {};
  return until_zero(record.substr(column.offset, size_of(column.format)));
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
  const auto names = split(until_zero(record.substr(25, 64)));
  std::size_t offset = kHead_bytes;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::size_t size = size_of(formats[i]);
    if (size == 0) return;
    if (i < names.size()) message.columns.push_back({std::string(names[i]), formats[i], offset});
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
  return value * (has_factor ? stated->second : implied_factor(column.format));
}

std::string_view Table::unit(const Column& column) const {
  const auto stated = units_.find(column.unit);
  if (stated == units_.end() || column.unit == '-' || column.unit == '?') return {};
  return stated->second;
}

}  // namespace navcal::analysis::dataflash
