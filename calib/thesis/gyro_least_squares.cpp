// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/gyro_least_squares.h"

#include <Eigen/LU>
#include <cmath>

namespace navcal::calib::thesis {

void GyroLeastSquares::update(double heading_rad, double roll_rad, double pitch_rad, double measured_rate_rad_s) {
  if (first_heading_rad_) {
    normal_ += row_ * row_.transpose();
    projected_ += row_ * (heading_rad - *first_heading_rad_);
  } else {
    first_heading_rad_ = heading_rad;
  }
  const double c = std::cos(roll_rad) / std::cos(pitch_rad);
  row_ += period_s_ * c * Eigen::Vector2d(measured_rate_rad_s, 1);
}

std::optional<Eigen::Vector2d> GyroLeastSquares::estimate() const {
  Eigen::Matrix2d inverse;
  bool regular = false;
  normal_.computeInverseWithCheck(inverse, regular, 1e-12 * normal_(0, 0) * normal_(1, 1));
  if (!regular) return std::nullopt;
  return inverse * projected_;
}

}  // namespace navcal::calib::thesis
