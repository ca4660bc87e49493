// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calib/archive.h"

namespace navcal::calib {

/// Model: |M (m - c)| = 1, down' M (m - c) = sine of dip; c in uT, M symmetric in 1/uT, body axes.
struct EllipsoidShape {
  Eigen::Vector3d centre_uT = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix_per_uT = Eigen::Matrix3d::Identity();
  double sine_of_dip = 0;

  static constexpr int kParameters = 10;  ///< c x y z; M xx, yy, zz, yz, xz, xy; sine of dip
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  [[nodiscard]] Eigen::Vector3d unit_field(const Eigen::Vector3d& field_body_uT) const {
    return matrix_per_uT * (field_body_uT - centre_uT);
  }
  /// d (M v) / d (the six of M), the transpose of which serves for w'M v too.
  [[nodiscard]] static Eigen::Matrix<double, 3, 6> slope_of_matrix(const Eigen::Vector3d& v);
  [[nodiscard]] EllipsoidShape moved(const Vector& step) const;
  /// Size of the field if soft iron neither adds to it nor takes from it.
  [[nodiscard]] double radius_uT() const;
  /// Finite, M positive definite, no axis ten times another, dip possible.
  [[nodiscard]] bool sane() const;

  void archive(Archive& archive) { archive(centre_uT, matrix_per_uT, sine_of_dip); }
};

/// Error of a shape, by noise and by an offset of the inclinometer from the compass's axes.
struct EllipsoidError {
  using ByTilt = Eigen::Matrix<double, EllipsoidShape::kParameters, 2>;
  EllipsoidShape::Matrix noise = EllipsoidShape::Matrix::Zero();
  ByTilt by_tilt_offset = ByTilt::Zero();  ///< derivative by the offset of roll, of pitch, 1/rad
  Eigen::Matrix2d tilt_offset_rad2 = Eigen::Matrix2d::Zero();

  [[nodiscard]] EllipsoidShape::Matrix covariance() const {
    return noise + by_tilt_offset * tilt_offset_rad2 * by_tilt_offset.transpose();
  }
};

/// Standard errors of `size_uT` times M. A size that is not known beforehand is that of the fit, so that only the
/// proportions of M are uncertain.
[[nodiscard]] Eigen::Matrix3d matrix_std(const EllipsoidShape& shape, const EllipsoidShape::Matrix& covariance,
                                         double size_uT, bool size_known);

/// Standard error of radius_uT() over itself.
[[nodiscard]] double relative_size_std(const EllipsoidShape& shape, const EllipsoidShape::Matrix& covariance);

/// Down in body axes.
[[nodiscard]] Eigen::Vector3d down_in_body(double roll_rad, double pitch_rad);

/// Error of the heading that the measured field gives without a calibration, at the worst heading of the circle,
/// level, 0 to pi.
[[nodiscard]] double worst_raw_heading_error_rad(const EllipsoidShape& shape);

/// Standard deviation of the calibrated heading at the worst heading of the circle with roll and pitch up to
/// `tilt_rad`, as the inclinometer reads them: its offset is in the shape as well, which level turns make up for.
[[nodiscard]] double worst_heading_std_rad(const EllipsoidShape& shape, const EllipsoidError& error,
                                           double tilt_rad);

}  // namespace navcal::calib
