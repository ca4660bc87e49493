// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "calib/calibrator.h"
#include "calib/correction.h"

namespace navcal::calib {

/// Coefficients of a deviation, as quantities and in JSON.
inline constexpr std::array<std::string_view, 5> kDeviationNames{"A_rad", "B_rad", "C_rad", "D_rad", "E_rad"};

[[nodiscard]] inline std::vector<NamedNumbers> values_of_deviation(const DeviationCorrection& deviation) {
  std::vector<NamedNumbers> values;
  for (std::size_t i = 0; i < kDeviationNames.size(); ++i)
    values.push_back({kDeviationNames[i], {deviation.coefficients_rad[i]}});
  return values;
}

}  // namespace navcal::calib
