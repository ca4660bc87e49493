// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::analysis::dataflash {

inline constexpr std::size_t kHead_bytes = 3;  ///< A3 95 and the type

/// A column of a message, as FMT and FMTU describe it.
struct Column {
  std::string name;
  char format = 0;
  std::size_t offset = 0;  ///< in the record, head counted
  char unit = 0;           ///< id of UNIT; 0: not stated
  char multiplier = 0;     ///< id of MULT; 0: not stated
};

struct MessageType {
  std::string name;
  std::size_t length = 0;  ///< of a record, head counted; 0: not defined
  std::vector<Column> columns;

  [[nodiscard]] const Column* find(std::string_view column) const;
  /// The column with the number of the instrument: I, Instance or Inst. Null: there is one only.
  [[nodiscard]] const Column* instance() const;
};

/// The descriptions that a DataFlash log carries of itself: FMT, FMTU, UNIT, MULT (AP_Logger/LogStructure.h of
/// ArduPilot).
class Table {
 public:
  Table();
  /// A record of one of the four; returns false for any other. A description that contradicts itself is passed
  /// over.
  bool learn(std::uint8_t type, std::string_view record);
  [[nodiscard]] const MessageType& operator[](std::uint8_t type) const { return types_[type]; }
  /// Number of descriptions learnt: what was bound to columns before is stale when it changes.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// Value in the unit of the column, its multiplier applied; nullopt for text.
  [[nodiscard]] std::optional<double> value(const Column& column, std::string_view record) const;
  /// Label of the column's unit, such as "rad/s"; empty when none is stated.
  [[nodiscard]] std::string_view unit(const Column& column) const;

 private:
  void learn_format(std::string_view record);
  void learn_units(std::string_view record);

  std::array<MessageType, 256> types_;
  std::map<char, std::string> units_;
  std::map<char, double> multipliers_;
  std::uint64_t version_ = 0;
};

/// Integer of a column without its multiplier, such as a time; nullopt for floating point and text.
[[nodiscard]] std::optional<std::int64_t> integer_of(const Column& column, std::string_view record);
/// Text of a column, without what follows its first zero.
[[nodiscard]] std::string_view text_of(const Column& column, std::string_view record);

}  // namespace navcal::analysis::dataflash
