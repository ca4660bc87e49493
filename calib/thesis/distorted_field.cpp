// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/distorted_field.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

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

double rms_heading_deg(const EllipseShape& shape, const EllipseShape::Matrix& covariance) {
  constexpr int kHeadings = 360;
  const Eigen::Matrix2d inverse = shape.axes_uT.inverse();
  double sum = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = i * base::kRadiansPerDegree;
    const Eigen::Vector2d across(-std::sin(heading), -std::cos(heading));
    const EllipseShape::Vector row = EllipseShape::slope(heading).transpose() * (inverse * across);
    sum += row.dot(covariance * row) / kHeadings;
  }
  return std::sqrt(sum) / base::kRadiansPerDegree;
}

EllipseEstimator::Parameters ellipse_parameters() {
  EllipseEstimator::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  return parameters;
}

double ellipse_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth) {
  EllipseShape::Matrix information = EllipseShape::Matrix::Zero();
  const double variance = Noise{}.field_uT * Noise{}.field_uT;
  for (const TruePoint& point : path) {
    const double heading = point.heading_rad;
    const Eigen::Vector2d tangent =
        (truth.axes_uT * Eigen::Vector2d(-std::sin(heading), -std::cos(heading))).normalized();
    const Eigen::Vector2d normal(-tangent.y(), tangent.x());
    const EllipseShape::Vector row = EllipseShape::slope(heading).transpose() * normal;
    information += row * row.transpose() / variance;
  }
  return rms_heading_deg(truth, information.inverse());
}

std::optional<CircleMoments> CircleMoments::fit(std::span<const Eigen::Vector2d> level_field_uT) {
  if (level_field_uT.size() < 2) return std::nullopt;
  CircleMoments moments;
  for (const auto& point : level_field_uT) moments.centre_uT += point;
  moments.centre_uT /= static_cast<double>(level_field_uT.size());
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const auto& point : level_field_uT) {
    const Eigen::Vector2d from_centre = point - moments.centre_uT;
    second += from_centre * from_centre.transpose();
  }
  // atan2 instead of the atan of (4.14), which cannot tell the major axis from the minor.
  const double alpha = 0.5 * std::atan2(2 * second(0, 1), second(0, 0) - second(1, 1));
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(alpha).toRotationMatrix();
  Eigen::Vector2d largest = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  for (const auto& point : level_field_uT) {
    largest = largest.cwiseMax(rotation.transpose() * (point - moments.centre_uT));
  }
  if (!(largest.y() > 0)) return std::nullopt;
  moments.matrix = rotation * Eigen::Vector2d(1, largest.x() / largest.y()).asDiagonal() * rotation.transpose();
  return moments;
}

}  // namespace navcal::calib::thesis
