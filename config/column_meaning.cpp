// SPDX-License-Identifier: Apache-2.0
#include "config/column_meaning.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/text_rows.h"

namespace navcal::config {

const char* column_meaning_rows();  // column_meanings.txt: "name meaning SAMPLE"

namespace {

using protocols::described::Dimension;
using protocols::described::Meaning;

std::vector<ColumnMeaning> read_meanings() {
  std::vector<ColumnMeaning> meanings;
  for (const auto& [name, rest] : base::text_rows(column_meaning_rows(), " ")) {
    const std::size_t space = rest.find(' ');
    meanings.push_back(
        {name, protocols::described::meaning_named(rest.substr(0, space)).value(), rest.substr(space + 1)});
  }
  return meanings;
}

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

std::span<const ColumnMeaning> column_meanings() {
  static const std::vector<ColumnMeaning> kMeanings = read_meanings();
  return kMeanings;
}

const ColumnMeaning* column_meaning_named(std::string_view name) {
  const auto meanings = column_meanings();
  for (const ColumnMeaning& row : meanings) {
    if (row.name == name) return &row;
  }
  const auto quantity = protocols::described::meaning_named(name);
  if (!quantity || quantity == Meaning::temperature)
    return nullptr;  // of which instrument, only the map's own name says
  const auto found = std::ranges::find(meanings, quantity, &ColumnMeaning::quantity);
  return found == meanings.end() ? nullptr : &*found;
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
