// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

namespace navcal::calib {

Eigen::Vector2d EllipseShape::foot(const Eigen::Vector2d& field_uT) const {
  const Eigen::Vector2d from_centre = field_uT - centre_uT;
  Eigen::Vector2d u = axes_uT.inverse() * from_centre;
  if (!(u.squaredNorm() > 0)) return direction(0);  // the centre itself, or not a number
  u.normalize();
  // Newton's iterations on half the squared distance, where it is convex; readings are near the ellipse, so two or
  // three of them reach the last digit. A step is a move along the tangent and back to the circle: no sine of an
  // angle is needed, and this is called for every cell in every iteration.
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d by_heading(u.y(), -u.x());
    const Eigen::Vector2d slope = axes_uT * by_heading;
    const Eigen::Vector2d off = from_centre - axes_uT * u;
    const double curvature = slope.squaredNorm() + off.dot(axes_uT * u);
    const double step = off.dot(slope) / std::max(curvature, 0.2 * slope.squaredNorm());
    u = (u + std::clamp(step, -0.5, 0.5) * by_heading).normalized();
    if (!(std::abs(step) > 1e-14)) break;
  }
  return u;
}

EllipseShape EllipseShape::moved(const Vector& step) const {
  EllipseShape shape = *this;
  shape.centre_uT += step.head<2>();
  shape.axes_uT(0, 0) += step[2];
  shape.axes_uT(0, 1) += step[3];
  shape.axes_uT(1, 0) += step[3];
  shape.axes_uT(1, 1) += step[4];
  return shape;
}

bool EllipseShape::sane() const {
  constexpr double kLargest_uT = 1e4;
  if (!centre_uT.allFinite() || !axes_uT.allFinite()) return false;
  if (centre_uT.cwiseAbs().maxCoeff() > kLargest_uT || axes_uT.cwiseAbs().maxCoeff() > kLargest_uT) return false;
  const double half = axes_uT.trace() / 2;
  const double apart = std::hypot((axes_uT(0, 0) - axes_uT(1, 1)) / 2, axes_uT(0, 1));
  return half - apart > 0.1 * (half + apart);
}

Eigen::Vector2d levelled(const Eigen::Vector3d& m, double roll_rad, double pitch_rad) {
  const double down = m.y() * std::sin(roll_rad) + m.z() * std::cos(roll_rad);
  return {m.x() * std::cos(pitch_rad) + down * std::sin(pitch_rad),
          m.y() * std::cos(roll_rad) - m.z() * std::sin(roll_rad)};
}

double worst_raw_heading_error_rad(const EllipseShape& shape) {
  constexpr int kHeadings = 72;
  double worst = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector2d measured = shape.at(heading);
    const double raw = std::atan2(-measured.y(), measured.x());
    worst = std::max(worst, std::abs(std::remainder(raw - heading, 2 * std::numbers::pi)));
  }
  return worst;
}

Eigen::Vector2d vertical_in_level(double roll_rad, double pitch_rad) {
  return {std::cos(roll_rad) * std::sin(pitch_rad), -std::sin(roll_rad)};
}

double worst_heading_std_rad(const EllipseShape& shape, const EllipseShape::Matrix& covariance) {
  constexpr int kHeadings = 72;
  const Eigen::Matrix2d inverse = shape.axes_uT.inverse();
  double worst = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector2d u = EllipseShape::direction(heading);
    const Eigen::Vector2d across(u.y(), -u.x());  // d u / d heading
    const EllipseShape::Vector row = EllipseShape::slope(u).transpose() * (inverse * across);
    worst = std::max(worst, row.dot(covariance * row));
  }
  return std::sqrt(worst);
}

FieldCorrection correction_of(const EllipseShape& shape) {
  FieldCorrection correction;
  correction.offset_uT.head<2>() = shape.centre_uT;
  correction.matrix.topLeftCorner<2, 2>() = shape.radius_uT() * shape.axes_uT.inverse();
  return correction;
}

}  // namespace navcal::calib
