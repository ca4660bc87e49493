// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/calibrator_unit.h"

#include <cmath>

namespace navcal::calib {

double std_of(double variance) { return variance >= 0 ? std::sqrt(variance) : kUnknownStd; }

Quantity determined(std::string_view name, double value, double std, double unknown) {
  if (!(std < unknown)) return {name, std::numeric_limits<double>::quiet_NaN(), kUnknownStd};
  return {name, value, std};
}

}  // namespace navcal::calib
