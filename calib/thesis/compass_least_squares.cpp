// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/compass_least_squares.h"

#include <Eigen/LU>
#include <cmath>

namespace navcal::calib::thesis {
namespace {

Eigen::Vector4d harmonics(double heading_rad) {
  return {std::sin(heading_rad), std::cos(heading_rad), std::sin(2 * heading_rad), std::cos(2 * heading_rad)};
}

}  // namespace

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
