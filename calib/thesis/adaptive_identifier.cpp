// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/adaptive_identifier.h"

#include <cmath>

namespace navcal::calib::thesis {

void AdaptiveIdentifier::update(double heading_rad, double roll_rad, double pitch_rad,
                                double measured_rate_rad_s) {
  if (!heading_rad_) heading_rad_ = heading_rad;
  const double error = *heading_rad_ - heading_rad;
  const double c = std::cos(roll_rad) / std::cos(pitch_rad);
  const Eigen::Vector2d f(measured_rate_rad_s, 1);
  *heading_rad_ += period_s_ * (kGain * error + c * f.dot(estimate_));
  // The cosine ratio is in (3.16) and not in (3.15).
  estimate_ -= period_s_ * error * kRates.cwiseProduct(f);
}

}  // namespace navcal::calib::thesis
