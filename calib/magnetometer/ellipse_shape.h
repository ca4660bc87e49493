// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "calib/archive.h"
#include "calib/correction.h"

namespace navcal::calib {

/// Sectors of heading within which neighbouring readings share their error.
inline constexpr std::size_t kSharedSectors = 36;

/// Model: levelled field = centre + S u(psi), u = (cos psi, -sin psi), psi the magnetic heading; uT, forward and
/// starboard, S symmetric: its size is the horizontal field's, its departure from a multiple of the unit matrix
/// soft iron. THESIS 4.18 turned round, without its rotation by the sampling.
struct EllipseShape {
  Eigen::Vector2d centre_uT = Eigen::Vector2d::Zero();
  Eigen::Matrix2d axes_uT = Eigen::Matrix2d::Identity();  ///< S

  static constexpr int kParameters = 5;  ///< centre x, y; S xx, xy, yy
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  [[nodiscard]] static Eigen::Vector2d direction(double heading_rad) {
    return {std::cos(heading_rad), -std::sin(heading_rad)};
  }
  [[nodiscard]] Eigen::Vector2d at(double heading_rad) const {
    return centre_uT + axes_uT * direction(heading_rad);
  }
  /// d at(heading) / d parameters, u = direction(heading).
  [[nodiscard]] static Eigen::Matrix<double, 2, kParameters> slope(const Eigen::Vector2d& u) {
    Eigen::Matrix<double, 2, kParameters> slope;
    slope << 1, 0, u.x(), u.y(), 0,  //
        0, 1, 0, u.x(), u.y();
    return slope;
  }
  [[nodiscard]] static Eigen::Matrix<double, 2, kParameters> slope(double heading_rad) {
    return slope(direction(heading_rad));
  }
  /// u of the nearest point of the ellipse.
  [[nodiscard]] Eigen::Vector2d foot(const Eigen::Vector2d& field_uT) const;
  /// Its heading.
  [[nodiscard]] double foot_rad(const Eigen::Vector2d& field_uT) const {
    const Eigen::Vector2d u = foot(field_uT);
    return std::atan2(-u.y(), u.x());
  }
  [[nodiscard]] EllipseShape moved(const Vector& step) const;
  /// Geometric mean of the axes: the size of the horizontal field but for what soft iron adds to it.
  [[nodiscard]] double radius_uT() const { return std::sqrt(axes_uT.determinant()); }
  /// Finite, S positive definite, and no axis ten times the other.
  [[nodiscard]] bool sane() const;

  void archive(Archive& archive) { archive(centre_uT, axes_uT); }
};

/// Where the horizontal field would be measured in body axes; thesis (2.2).
[[nodiscard]] Eigen::Vector2d levelled(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);

/// Error of the heading that the levelled field gives without a calibration, at the worst heading of the circle, 0
/// to pi.
[[nodiscard]] double worst_raw_heading_error_rad(const EllipseShape& shape);

/// Derivative of the levelled field with respect to a vertical offset (uT per uT).
[[nodiscard]] Eigen::Vector2d vertical_in_level(double roll_rad, double pitch_rad);

/// Standard deviation of the vertical offset of a magnetometer near batteries and motors. A level fit does not
/// determine this offset.
inline constexpr double kVerticalOffset_uT = 20;

/// Standard deviation of the calibrated heading at the worst heading of the circle, by first order.
[[nodiscard]] double worst_heading_std_rad(const EllipseShape& shape, const EllipseShape::Matrix& covariance);

/// matrix = radius * S^-1 and the offset, in three dimensions: nothing is said of the vertical.
[[nodiscard]] FieldCorrection correction_of(const EllipseShape& shape);

}  // namespace navcal::calib
