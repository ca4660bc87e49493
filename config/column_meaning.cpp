// SPDX-License-Identifier: Apache-2.0
#include "config/column_meaning.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace navcal::config {
namespace {

using protocols::described::Dimension;
using protocols::described::Meaning;

constexpr auto kMeanings = [] {
  using enum Meaning;
  return std::array<ColumnMeaning, 40>{{
      {"heading", heading, "COMPASS"},
      {"pitch", pitch, "COMPASS"},
      {"roll", roll, "COMPASS"},
      {"compass_temperature", temperature, "COMPASS"},
      {"field_x", field_x, "COMPASS"},
      {"field_y", field_y, "COMPASS"},
      {"field_z", field_z, "COMPASS"},
      {"rate_x", rate_x, "IMU"},
      {"rate_y", rate_y, "IMU"},
      {"rate_z", rate_z, "IMU"},
      {"rate_yaw_b", rate_yaw_b, "IMU"},
      {"imu_depth", depth, "IMU"},
      {"force_x", specific_force_x, "IMU"},
      {"force_y", specific_force_y, "IMU"},
      {"force_z", specific_force_z, "IMU"},
      {"lat", latitude, "GPS"},
      {"lon", longitude, "GPS"},
      {"height", height, "GPS"},
      {"height_msl", height_msl, "GPS"},
      {"speed", speed, "GPS"},
      {"course", course, "GPS"},
      {"climb", climb, "GPS"},
      {"depth", depth, "DEPTH"},
      {"pressure", pressure, "DEPTH"},
      {"altitude", altitude, "ALTIMETER"},
      {"bottom_velocity_x", bottom_velocity_x, "DVL"},
      {"bottom_velocity_y", bottom_velocity_y, "DVL"},
      {"bottom_velocity_z", bottom_velocity_z, "DVL"},
      {"water_velocity_x", water_velocity_x, "DVL"},
      {"water_velocity_y", water_velocity_y, "DVL"},
      {"water_velocity_z", water_velocity_z, "DVL"},
      {"rpm", rpm, "MOTOR"},
      {"rpm_commanded", rpm_commanded, "MOTOR"},
      {"fin_1", fin_1, "MOTOR"},
      {"fin_2", fin_2, "MOTOR"},
      {"fin_3", fin_3, "MOTOR"},
      {"motor_current", motor_current, "MOTOR"},
      {"voltage", voltage, "POWER"},
      {"current", current, "POWER"},
      {"sensor", sensor, "SENSOR"},
  }};
}();

/// Degrees in a place, which is in degrees in a sample's text.
constexpr std::array kPlaceUnits{ColumnUnit{"deg", Dimension::angle},
                                 ColumnUnit{"rad", Dimension::angle, 1 / (std::numbers::pi / 180)},
                                 ColumnUnit{"deg*1e7", Dimension::angle, 1e-7}};

constexpr double kStandardGravity_m_s2 = 9.80665;
/// Instead of those of descriptions, whose g is that of the simulated vehicles (base/gravity.h).
constexpr std::array kOwnUnits{ColumnUnit{"T", Dimension::magnetic_field, 1e6},
                               ColumnUnit{"rps", Dimension::rotation, 60},
                               ColumnUnit{"g", Dimension::acceleration, kStandardGravity_m_s2},
                               ColumnUnit{"mg", Dimension::acceleration, kStandardGravity_m_s2 * 1e-3}};

std::vector<ColumnUnit> units_of(Meaning quantity) {
  if (quantity == Meaning::latitude || quantity == Meaning::longitude)
    return {kPlaceUnits.begin(), kPlaceUnits.end()};
  std::vector<ColumnUnit> units;
  const auto add = [&](const ColumnUnit& unit) {
    if (unit.dimension == info_of(quantity).dimension) units.push_back(unit);
  };
  const auto is_own = [](const ColumnUnit& unit) {
    return std::ranges::any_of(kOwnUnits, [&](const ColumnUnit& own) { return own.name == unit.name; });
  };
  for (const ColumnUnit& unit : protocols::described::all_units()) {
    if (!is_own(unit)) add(unit);
  }
  for (const ColumnUnit& unit : kOwnUnits) add(unit);
  return units;
}

}  // namespace

std::span<const ColumnMeaning> column_meanings() { return kMeanings; }

const ColumnMeaning* column_meaning_named(std::string_view name) {
  for (const ColumnMeaning& row : kMeanings) {
    if (row.name == name) return &row;
  }
  const auto quantity = protocols::described::meaning_named(name);
  if (!quantity || quantity == Meaning::temperature)
    return nullptr;  // of which instrument, only the map's own name says
  const auto* const found = std::ranges::find(kMeanings, quantity, &ColumnMeaning::quantity);
  return found == kMeanings.end() ? nullptr : found;
}

std::optional<ColumnUnit> column_unit(Meaning quantity, std::string_view name) {
  for (const ColumnUnit& unit : units_of(quantity)) {
    if (unit.name == name) return unit;
  }
  return std::nullopt;
}

std::vector<std::string> column_units(Meaning quantity) {
  std::vector<std::string> names;
  for (const ColumnUnit& unit : units_of(quantity)) names.emplace_back(unit.name);
  return names;
}

}  // namespace navcal::config
