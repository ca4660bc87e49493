// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "record/export/topic_columns.h"

namespace navcal::record {

/// Texts of a column, equal ones kept once.
class TextColumn {
 public:
  TextColumn() = default;
  TextColumn(TextColumn&&) = default;  // not copied: rows point into it
  TextColumn& operator=(TextColumn&&) = default;
  void append(std::string_view text);
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const std::string& at(std::size_t row) const { return *rows_[row]; }
  /// Bytes of the longest.
  [[nodiscard]] std::size_t width() const { return width_; }

 private:
  std::unordered_map<std::string, std::size_t> distinct_;  // its keys stay where they are
  std::vector<const std::string*> rows_;
  std::size_t width_ = 0;
};

/// Seconds of the log that a double could not hold to the nanosecond: times, and what else /time says of clocks.
struct NanosecondColumn {
  static constexpr std::int64_t kAbsent = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> rows;
  bool utc = false;  ///< since 1970-01-01; else an interval
};

/// False, true, or absent.
struct BooleanColumn {
  static constexpr std::int8_t kAbsent = -1;
  std::vector<std::int8_t> rows;
};

/// NaN: absent.
struct NumberColumn {
  std::vector<double> rows;
};

/// The messages of one topic, column by column, in memory: about a fifth of what they take in the log.
class TopicTable {
 public:
  using Values = std::variant<NumberColumn, NanosecondColumn, BooleanColumn, TextColumn>;
  struct Column {
    TopicColumn head;
    Values values;
  };

  /// `topic` as in a log: "/imu". One without listed members has two columns, time_s and json.
  explicit TopicTable(std::string_view topic);

  /// False when it is not JSON; nothing is appended then.
  [[nodiscard]] bool append(std::string_view json, std::int64_t log_utc_ns);

  [[nodiscard]] const std::string& topic() const { return topic_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::span<const Column> columns() const { return columns_; }
  /// UTC, the first column; a message without has that of its arrival.
  [[nodiscard]] const std::vector<std::int64_t>& times_ns() const;
  [[nodiscard]] bool times_increase() const;

 private:
  void append(Column& column, std::string_view text);

  std::string topic_;
  bool listed_ = false;
  std::vector<Column> columns_;
  std::size_t rows_ = 0;
};

}  // namespace navcal::record
