// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/heading_least_squares.h"

#include <Eigen/LU>
#include <cmath>

#include "calib/thesis/measured_path.h"

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

void CompassLeastSquares::update(double measured_heading_rad, double heading_rate_rad_s) {
  if (first_heading_rad_) {
    const Eigen::Vector4d row = harmonics(*first_heading_rad_) - harmonics(measured_heading_rad);
    normal_ += row * row.transpose();
    projected_ += row * (turned_rad_ - (measured_heading_rad - *first_heading_rad_));
  } else {
    first_heading_rad_ = measured_heading_rad;
  }
  turned_rad_ += period_s_ * heading_rate_rad_s;
}

std::optional<Eigen::Vector4d> CompassLeastSquares::estimate() const {
  const Eigen::FullPivLU<Eigen::Matrix4d> factors(normal_);
  if (!factors.isInvertible()) return std::nullopt;
  return factors.solve(projected_);
}

}  // namespace navcal::calib::thesis
