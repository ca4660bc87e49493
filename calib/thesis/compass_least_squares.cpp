// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/compass_least_squares.h"

#include <Eigen/LU>

#include "calib/thesis/measured_path.h"

namespace navcal::calib::thesis {

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
