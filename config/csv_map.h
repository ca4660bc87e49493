// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/column_meaning.h"

namespace navcal::config {

/// A corner of a curve.
struct CurvePoint {
  double from = 0;  ///< number in the file
  double to = 0;    ///< value in navcal's unit
};

/// A column of a CSV file, or a channel of another log ("RCOU.C1").
struct CsvColumn {
  std::string name;  ///< as the header line has it; "1", "2", ... where there is none
  ColumnMeaning meaning;
  double factor = 1;     ///< of the number in the file, to navcal's unit of the meaning; degrees of lat and lon
  double offset = 0;     ///< added afterwards, in navcal's unit
  int instance = 0;      ///< 0 for the first instrument of its kind
  std::string quantity;  ///< of a sensor
  std::string unit;      ///< of a sensor, as the file states it
  /// Instead of factor and offset: straight lines between these, `from` increasing. Empty, or two and more.
  std::vector<CurvePoint> curve;
  unsigned line = 0;  ///< of its table in the map

  /// Value in navcal's unit. Beyond a curve it is that of the curve's end.
  [[nodiscard]] double value(double number) const;
  /// Whether a curve is there that does not reach so far.
  [[nodiscard]] bool is_beyond(double number) const;
};

enum class CsvTime : std::uint8_t {
  unix_s,
  unix_ms,
  unix_us,
  unix_ns,  ///< UTC since 1970-01-01
  s,
  ms,
  us,
  ns,  ///< since an unknown moment, or since CsvMap::start_ns
  iso8601,
  pattern,  ///< CsvMap::pattern, as strptime(3) reads it, in UTC; decimals of a second may follow
};

/// What the columns of a CSV file mean.
struct CsvMap {
  char delimiter = ',';
  bool decimal_comma = false;
  int header = 1;                         ///< number of the line with the names of the columns; 0: there is none
  std::string comment;                    ///< lines that begin with it are passed over; empty: none
  std::vector<std::string> time_columns;  ///< joined by a blank where the date has a column of its own
  CsvTime time = CsvTime::unix_s;
  std::string pattern;
  std::optional<std::int64_t> start_ns;  ///< UTC at which s, ms, us or ns count from 0
  std::vector<CsvColumn> columns;
};

/// Throws Error with all problems, by line and key.
[[nodiscard]] CsvMap parse_csv_map(std::string_view toml, std::string_view name);
[[nodiscard]] CsvMap load_csv_map(const std::filesystem::path& file);

/// Meaning of the channels of a log that describes itself, such as DataFlash.
struct ChannelMap {
  std::string file;  ///< for messages
  std::vector<CsvColumn> channels;
};

/// A map that has tables [column.NAME] only, of shaft and fins. Throws Error as above.
[[nodiscard]] ChannelMap parse_channel_map(std::string_view toml, std::string_view name);
[[nodiscard]] ChannelMap load_channel_map(const std::filesystem::path& file);

/// "2024-05-01T12:00:00.25Z", with `+02:00` instead of Z, or neither (then UTC); a blank may stand for T.
[[nodiscard]] std::optional<std::int64_t> parse_iso_time(std::string_view text);

}  // namespace navcal::config
