// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/lamb_factors.h"

#include <cmath>

namespace navcal::sim {

LambFactors lamb_factors(double length_m, double diameter_m) {
  const double e2 = 1 - std::pow(diameter_m / length_m, 2);
  const double e = std::sqrt(e2);
  const double logarithm = std::log((1 + e) / (1 - e));
  const double alpha = 2 * (1 - e2) / (e2 * e) * (logarithm / 2 - e);
  const double beta = 1 / e2 - (1 - e2) / (2 * e2 * e) * logarithm;
  const double difference = beta - alpha;
  return {alpha / (2 - alpha), beta / (2 - beta),
          e2 * e2 * difference / ((2 - e2) * (2 * e2 - (2 - e2) * difference))};
}

}  // namespace navcal::sim
