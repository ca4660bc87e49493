// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "sim/state.h"

namespace navcal::sim {

/// Model: tau y' + y = x, begun settled at the first x. Between two calls x is taken to go straight from one to
/// the other, so that the answer hardly depends on how often it is called. Time that stands still or goes back
/// changes nothing; tau = 0 follows at once.
class LowPass {
 public:
  [[nodiscard]] Vector3 at(double time_s, const Vector3& x, double tau_s) {
    if (!time_s_ || tau_s <= 0) {
      y_ = x;
    } else if (const double step_s = time_s - *time_s_; step_s > 0) {
      const double ratio = step_s / tau_s;
      const double kept = std::exp(-ratio);
      const double mean = -std::expm1(-ratio) / ratio;
      for (std::size_t i = 0; i < 3; ++i) y_[i] = kept * y_[i] + (mean - kept) * x_[i] + (1 - mean) * x[i];
    } else {
      return y_;
    }
    time_s_ = time_s;
    x_ = x;
    return y_;
  }

 private:
  std::optional<double> time_s_;
  Vector3 x_{}, y_{};
};

}  // namespace navcal::sim
