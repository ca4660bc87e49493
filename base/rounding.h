// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace navcal::base {

/// The multiple of `resolution` next to `value`.
[[nodiscard]] inline double rounded(double value, double resolution) {
  return std::round(value / resolution) * resolution;
}

}  // namespace navcal::base
