// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/described/meaning.h"

namespace navcal::config {

/// Meaning of a column of a CSV file, or of a channel of another log: a quantity, and the class of the sample that
/// has it (instruments/sample_fields.h).
struct ColumnMeaning {
  std::string_view name = "sensor";  ///< as a map of columns has it
  protocols::described::Meaning quantity = protocols::described::Meaning::sensor;
  std::string_view sample = "SENSOR";

  [[nodiscard]] bool is_motor() const { return sample == "MOTOR"; }
};

/// In the order in which samples are written.
[[nodiscard]] std::span<const ColumnMeaning> column_meanings();
/// The meaning of that name, which is one of a map of columns ("rate_x") or of a description of a device
/// ("rate.x"); nullptr for another name.
[[nodiscard]] const ColumnMeaning* column_meaning_named(std::string_view name);

using ColumnUnit = protocols::described::Unit;
/// A unit in which a column can be, with what makes a number in it one of the sample (latitude and longitude in
/// degrees). nullopt for a unit that does not fit.
[[nodiscard]] std::optional<ColumnUnit> column_unit(protocols::described::Meaning quantity, std::string_view name);
[[nodiscard]] std::vector<std::string> column_units(protocols::described::Meaning quantity);

}  // namespace navcal::config
