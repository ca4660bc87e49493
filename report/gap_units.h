// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace navcal::report {

/// Splits a parameter's name into name and unit: "x_uT_per_A" is "x" in "uT/A", "deg_per_s_per_C_ax" is "ax" in
/// "deg/s/C", "per_A" is nameless in "1/A", "gain" has no unit.
struct NameAndUnit {
  std::string name, unit;
};
[[nodiscard]] NameAndUnit name_and_unit(std::string_view parameter);

}  // namespace navcal::report
