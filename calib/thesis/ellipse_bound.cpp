// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/ellipse_bound.h"

#include <Eigen/Dense>
#include <cmath>

#include "base/angles.h"

namespace navcal::calib::thesis {

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

}  // namespace navcal::calib::thesis
