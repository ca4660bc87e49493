// SPDX-License-Identifier: Apache-2.0
#include "config/column_meaning.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace navcal::config {
namespace {

struct MeaningRow {
  std::string_view name;
  Measure measure;
};

constexpr std::array<MeaningRow, 40> kMeanings{{
    {"heading", Measure::angle},
    {"pitch", Measure::angle},
    {"roll", Measure::angle},
    {"compass_temperature", Measure::temperature},
    {"field_x", Measure::field},
    {"field_y", Measure::field},
    {"field_z", Measure::field},
    {"rate_x", Measure::rate},
    {"rate_y", Measure::rate},
    {"rate_z", Measure::rate},
    {"rate_yaw_b", Measure::rate},
    {"force_x", Measure::force},
    {"force_y", Measure::force},
    {"force_z", Measure::force},
    {"lat", Measure::degrees},
    {"lon", Measure::degrees},
    {"height", Measure::length},
    {"height_msl", Measure::length},
    {"speed", Measure::speed},
    {"course", Measure::angle},
    {"climb", Measure::speed},
    {"depth", Measure::length},
    {"imu_depth", Measure::length},
    {"pressure", Measure::pressure},
    {"altitude", Measure::length},
    {"bottom_velocity_x", Measure::speed},
    {"bottom_velocity_y", Measure::speed},
    {"bottom_velocity_z", Measure::speed},
    {"water_velocity_x", Measure::speed},
    {"water_velocity_y", Measure::speed},
    {"water_velocity_z", Measure::speed},
    {"rpm", Measure::turns},
    {"rpm_commanded", Measure::turns},
    {"fin_1", Measure::angle},
    {"fin_2", Measure::angle},
    {"fin_3", Measure::angle},
    {"motor_current", Measure::current},
    {"voltage", Measure::voltage},
    {"current", Measure::current},
    {"sensor", Measure::anything},
}};

struct UnitRow {
  std::string_view name;
  Measure measure;
  double factor;
  double zero = 0;
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStandardGravity_m_s2 = 9.80665;
constexpr double kKnot_m_s = 1852.0 / 3600;
/// The first unit of each measure is navcal's own, and counts where a column states none.
constexpr std::array kUnits{UnitRow{"rad", Measure::angle, 1},
                            UnitRow{"deg", Measure::angle, kDegree},
                            UnitRow{"deg", Measure::degrees, 1},
                            UnitRow{"rad", Measure::degrees, 1 / kDegree},
                            UnitRow{"deg*1e7", Measure::degrees, 1e-7},
                            UnitRow{"uT", Measure::field, 1},
                            UnitRow{"nT", Measure::field, 1e-3},
                            UnitRow{"T", Measure::field, 1e6},
                            UnitRow{"G", Measure::field, 100},
                            UnitRow{"mG", Measure::field, 0.1},
                            UnitRow{"rad/s", Measure::rate, 1},
                            UnitRow{"deg/s", Measure::rate, kDegree},
                            UnitRow{"m/s2", Measure::force, 1},
                            UnitRow{"g", Measure::force, kStandardGravity_m_s2},
                            UnitRow{"mg", Measure::force, kStandardGravity_m_s2 * 1e-3},
                            UnitRow{"m", Measure::length, 1},
                            UnitRow{"cm", Measure::length, 1e-2},
                            UnitRow{"mm", Measure::length, 1e-3},
                            UnitRow{"ft", Measure::length, 0.3048},
                            UnitRow{"m/s", Measure::speed, 1},
                            UnitRow{"cm/s", Measure::speed, 1e-2},
                            UnitRow{"mm/s", Measure::speed, 1e-3},
                            UnitRow{"kn", Measure::speed, kKnot_m_s},
                            UnitRow{"km/h", Measure::speed, 1 / 3.6},
                            UnitRow{"Pa", Measure::pressure, 1},
                            UnitRow{"hPa", Measure::pressure, 100},
                            UnitRow{"mbar", Measure::pressure, 100},
                            UnitRow{"kPa", Measure::pressure, 1e3},
                            UnitRow{"bar", Measure::pressure, 1e5},
                            UnitRow{"dbar", Measure::pressure, 1e4},
                            UnitRow{"rpm", Measure::turns, 1},
                            UnitRow{"rps", Measure::turns, 60},
                            UnitRow{"V", Measure::voltage, 1},
                            UnitRow{"mV", Measure::voltage, 1e-3},
                            UnitRow{"A", Measure::current, 1},
                            UnitRow{"mA", Measure::current, 1e-3},
                            UnitRow{"C", Measure::temperature, 1},
                            UnitRow{"K", Measure::temperature, 1, -273.15}};

}  // namespace

std::optional<CsvMeaning> csv_meaning_named(std::string_view name) {
  const auto found =
      std::find_if(kMeanings.begin(), kMeanings.end(), [&](const MeaningRow& row) { return row.name == name; });
  return found == kMeanings.end() ? std::nullopt
                                  : std::optional(static_cast<CsvMeaning>(found - kMeanings.begin()));
}

Measure measure_of(CsvMeaning meaning) { return kMeanings[static_cast<std::size_t>(meaning)].measure; }

std::vector<std::string> csv_meanings() {
  std::vector<std::string> names;
  for (const MeaningRow& row : kMeanings) names.emplace_back(row.name);
  return names;
}

bool is_motor_meaning(CsvMeaning meaning) {
  return meaning >= CsvMeaning::rpm && meaning <= CsvMeaning::motor_current;
}

std::vector<std::string> motor_meanings() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kMeanings.size(); ++i) {
    if (is_motor_meaning(static_cast<CsvMeaning>(i))) names.emplace_back(kMeanings[i].name);
  }
  return names;
}

std::optional<CsvUnit> csv_unit(Measure measure, std::string_view name) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRow& unit) {
    return unit.measure == measure && unit.name == name;
  });
  return found == kUnits.end() ? std::nullopt : std::optional(CsvUnit{found->factor, found->zero});
}

std::vector<std::string> csv_units_of(Measure measure) {
  std::vector<std::string> names;
  for (const UnitRow& unit : kUnits) {
    if (unit.measure == measure) names.emplace_back(unit.name);
  }
  return names;
}

}  // namespace navcal::config
