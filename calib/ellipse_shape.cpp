#include "calib/ellipse_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

namespace navcal::calib {

double EllipseShape::heading_rad(const Eigen::Vector2d& field_uT) const {
  const Eigen::Vector2d y = axes_uT.inverse() * (field_uT - centre_uT);
  return std::atan2(-y.y(), y.x());
}

double EllipseShape::foot_rad(const Eigen::Vector2d& field_uT) const {
  double heading = heading_rad(field_uT);
  // Newton's iterations on half the squared distance, where it is convex; readings are near the ellipse, so two or
  // three of them reach the last digit.
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d u = direction(heading);
    const Eigen::Vector2d slope = axes_uT * Eigen::Vector2d(u.y(), -u.x());
    const Eigen::Vector2d off = field_uT - centre_uT - axes_uT * u;
    const double curvature = slope.squaredNorm() + off.dot(axes_uT * u);
    const double step = off.dot(slope) / std::max(curvature, 0.2 * slope.squaredNorm());
    heading += std::clamp(step, -0.5, 0.5);
    if (!(std::abs(step) > 1e-14)) break;
  }
  return heading;
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

double worst_heading_std_rad(const EllipseShape& shape, const EllipseShape::Matrix& covariance) {
  constexpr int kHeadings = 72;
  const Eigen::Matrix2d inverse = shape.axes_uT.inverse();
  double worst = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector2d across(-std::sin(heading), -std::cos(heading));  // d u / d heading
    const EllipseShape::Vector row = EllipseShape::slope(heading).transpose() * (inverse * across);
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
