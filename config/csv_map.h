// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::config {

/// What a column of a CSV file can mean. The values are in the order of the names that a map uses.
enum class CsvMeaning : std::uint8_t {
  heading,
  pitch,
  roll,
  field_x,
  field_y,
  field_z,
  rate_x,
  rate_y,
  rate_z,
  force_x,
  force_y,
  force_z,
  lat,
  lon,
  height,
  height_msl,
  speed,
  course,
  climb,
  depth,
  pressure,
  altitude,
  bottom_velocity_x,
  bottom_velocity_y,
  bottom_velocity_z,
  water_velocity_x,
  water_velocity_y,
  water_velocity_z,
  rpm,
  rpm_commanded,
  fin_1,
  fin_2,
  fin_3,
  voltage,
  current,
  sensor,
};

struct CsvColumn {
  std::string name;  ///< as the header line has it; "1", "2", ... where there is none
  CsvMeaning meaning = CsvMeaning::sensor;
  double factor = 1;     ///< of the number in the file, to navcal's unit of the meaning; degrees of lat and lon
  double offset = 0;     ///< added afterwards, in navcal's unit
  int instance = 0;      ///< 0 for the first instrument of its kind
  std::string quantity;  ///< of a sensor
  std::string unit;      ///< of a sensor, as the file states it
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

/// The names of CsvMeaning, such as "heading".
[[nodiscard]] std::vector<std::string> csv_meanings();

/// "2024-05-01T12:00:00.25Z", with `+02:00` instead of Z, or neither (then UTC); a blank may stand for T.
[[nodiscard]] std::optional<std::int64_t> parse_iso_time(std::string_view text);

}  // namespace navcal::config
