// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "config/layout.h"

namespace navcal::config {

/// Numbers of a layout that stand under one key of its file.
struct LayoutNumbers {
  double* values = nullptr;
  std::size_t count = 1;      ///< 36 for a matrix
  double per_file_unit = 1;   ///< value in the layout over value in the file (degrees)
  std::string_view unit;      ///< of the file
  bool is_positive = false;   ///< never negative: masses, lengths, areas, lags
  bool is_symmetric = false;  ///< a matrix whose elements across the diagonal are one number
};

/// The numbers under this key ("body.mass_kg", "thruster[2].lag_s", as in LayoutUncertainty); nullopt when the
/// layout has no such key. After a change of them: body.set_buoyancy().
[[nodiscard]] std::optional<LayoutNumbers> find_numbers(Layout& layout, std::string_view key);

}  // namespace navcal::config
