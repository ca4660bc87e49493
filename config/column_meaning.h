// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::config {

/// Meaning of a column of a CSV file, or of a channel of another log. The values are in the order of the names
/// that a map uses.
enum class CsvMeaning : std::uint8_t {
  heading,
  pitch,
  roll,
  compass_temperature,
  field_x,
  field_y,
  field_z,
  rate_x,
  rate_y,
  rate_z,
  rate_yaw_b,
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
  imu_depth,
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
  motor_current,
  voltage,
  current,
  sensor,
};

/// Nature of a quantity: it decides which units fit.
enum class Measure : std::uint8_t {
  angle,
  degrees,
  field,
  rate,
  force,
  length,
  speed,
  pressure,
  turns,
  voltage,
  current,
  temperature,
  anything,
};

/// nullopt for a name that is no meaning.
[[nodiscard]] std::optional<CsvMeaning> csv_meaning_named(std::string_view name);
[[nodiscard]] Measure measure_of(CsvMeaning meaning);
/// The names of CsvMeaning, such as "heading".
[[nodiscard]] std::vector<std::string> csv_meanings();
/// Those of shaft and fins, which a channel of a log other than CSV can have.
[[nodiscard]] std::vector<std::string> motor_meanings();
[[nodiscard]] bool is_motor_meaning(CsvMeaning meaning);

/// A unit as a line to navcal's unit of the measure: number * factor + zero.
struct CsvUnit {
  double factor = 1;
  double zero = 0;
};
/// nullopt for a unit that does not fit.
[[nodiscard]] std::optional<CsvUnit> csv_unit(Measure measure, std::string_view name);
[[nodiscard]] std::vector<std::string> csv_units_of(Measure measure);

}  // namespace navcal::config
