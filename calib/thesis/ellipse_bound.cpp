// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/ellipse_bound.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <utility>

#include "base/angles.h"

namespace navcal::calib::thesis {

namespace {

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

/// d field / d heading.
Eigen::Vector2d along(const EllipseShape& shape, double heading) {
  return shape.axes_uT * Eigen::Vector2d(-std::sin(heading), -std::cos(heading));
}

}  // namespace

EllipseEstimator::Parameters ellipse_parameters() {
  EllipseEstimator::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  return parameters;
}

EllipseGyro::Parameters gyro_parameters(bool unknown) {
  EllipseGyro::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(kPeriod_s);
  if (unknown) return parameters;
  parameters.gyro.mean = {kTrueScale, kTrueBias_rad_s};
  parameters.gyro.covariance = 1e-12 * Eigen::Matrix2d::Identity();
  return parameters;
}

double ellipse_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth) {
  EllipseShape::Matrix information = EllipseShape::Matrix::Zero();
  const double variance = Noise{}.field_uT * Noise{}.field_uT;
  for (const TruePoint& point : path) {
    const Eigen::Vector2d tangent = along(truth, point.heading_rad).normalized();
    const Eigen::Vector2d normal(-tangent.y(), tangent.x());
    const EllipseShape::Vector row = EllipseShape::slope(point.heading_rad).transpose() * normal;
    information += row * row.transpose() / variance;
  }
  return rms_heading_deg(truth, information.inverse());
}

double gyro_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth, bool unknown) {
  const auto parameters = gyro_parameters(unknown);
  const Eigen::Index first = EllipseShape::kParameters + 2;  // then the headings
  const auto count = static_cast<Eigen::Index>(path.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(first + count, first + count);
  information.block<2, 2>(5, 5) = parameters.gyro.covariance.inverse();
  const double variance = Noise{}.field_uT * Noise{}.field_uT;
  for (Eigen::Index k = 0; k < count; ++k) {
    const TruePoint& point = path[static_cast<std::size_t>(k)];
    Eigen::Matrix<double, 2, 6> slope;
    slope << EllipseShape::slope(point.heading_rad), along(truth, point.heading_rad);
    const Eigen::Matrix<double, 6, 6> told = slope.transpose() * slope / variance;
    const auto place = [&](Eigen::Index i) { return i < 5 ? i : first + k; };
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) information(place(i), place(j)) += told(i, j);
    }
    if (k == 0) continue;
    const TruePoint& before = path[static_cast<std::size_t>(k - 1)];
    const double turned = point.heading_rad - before.heading_rad;
    const double link = 1 / std::pow(kTrueScale * parameters.rate_noise_rad_sqrt_s, 2) / kPeriod_s;
    const double measured = (turned - kTrueBias_rad_s * kPeriod_s) / kTrueScale;
    const std::array<std::pair<Eigen::Index, double>, 4> terms{
        {{5, -measured}, {6, -kPeriod_s}, {first + k - 1, -1}, {first + k, 1}}};
    for (const auto& [i, a] : terms) {
      for (const auto& [j, b] : terms) information(i, j) += link * a * b;
    }
  }
  // Only the first columns of the inverse are wanted.
  const Eigen::MatrixXd columns = information.ldlt().solve(Eigen::MatrixXd::Identity(first + count, first));
  EllipseShape::Matrix covariance;
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) covariance(i, j) = columns(i, j);
  }
  return rms_heading_deg(truth, covariance);
}

}  // namespace navcal::calib::thesis
