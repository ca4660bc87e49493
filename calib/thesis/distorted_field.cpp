// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/distorted_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace navcal::calib::thesis {

EllipseShape distorted_circle(const FieldDistortion& distortion) {
  const Eigen::Matrix2d turn =
      Eigen::Rotation2Dd(distortion.axis_deg * base::kRadiansPerDegree).toRotationMatrix();
  const double minor = std::sqrt(1 - distortion.eccentricity * distortion.eccentricity);
  EllipseShape shape;
  shape.centre_uT = distortion.shift_uT;
  shape.axes_uT = kCircle_uT * turn * Eigen::Vector2d(1, minor).asDiagonal() * turn.transpose();
  return shape;
}

EllipseShape figure_4_11() { return distorted_circle({{2, 2}, 0.5, 120}); }
EllipseShape figure_4_12() { return distorted_circle({{2, -4}, 0.8, 10}); }

double heading_error_rad(const FieldCorrection& found, const EllipseShape& truth, double heading_rad) {
  Eigen::Vector3d field = Eigen::Vector3d::Zero();
  field.head<2>() = truth.at(heading_rad);
  return base::wrapped(levelled_heading(found(field), 0, 0) - heading_rad);
}

HeadingError heading_error(const FieldCorrection& found, const EllipseShape& truth) {
  constexpr int kHeadings = 360;
  HeadingError error;
  for (int i = 0; i < kHeadings; ++i) {
    const double off = heading_error_rad(found, truth, i * base::kRadiansPerDegree) * base::kDegreesPerRadian;
    error.largest_deg = std::max(error.largest_deg, std::abs(off));
    error.rms_deg += off * off / kHeadings;
  }
  error.rms_deg = std::sqrt(error.rms_deg);
  return error;
}

}  // namespace navcal::calib::thesis
