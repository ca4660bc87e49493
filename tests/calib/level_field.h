// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "calib/magnetometer/ellipse_gyro.h"
#include "calib/thesis/distorted_field.h"
#include "calib/thesis/measured_path.h"
#include "calib/turn/turn_integrator.h"

/// The level magnetic fields of the thesis with its gyro, and the accuracy that can be had of both.
namespace navcal::calib::thesis {

struct FieldReading {
  Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
  double roll_rad = 0, pitch_rad = 0;
  TurnStep turn;  ///< by the thesis's gyro
};

/// The level field of `shape` along a path, with noise; the gyro is the thesis's (2.11).
inline std::vector<FieldReading> level_field_on(const std::vector<TruePoint>& path, const EllipseShape& shape,
                                                const Noise& noise, Random& random) {
  const std::vector<Measured> measured = measure(path, Deviation::Zero(), noise, random);
  std::normal_distribution<double> normal;
  TurnIntegrator integrator({});
  std::vector<FieldReading> readings;
  readings.reserve(path.size());
  const auto take = [&] {
    while (const auto step = integrator.next()) {
      FieldReading reading;
      const Eigen::Vector2d field = shape.at(path[readings.size()].heading_rad) +
                                    noise.field_uT * Eigen::Vector2d(normal(random), normal(random));
      reading.field_body_uT.head<2>() = field;
      reading.turn = *step;
      readings.push_back(reading);
    }
  };
  for (const Measured& m : measured) {
    RateReading rate = rate_of(m);
    rate.yaw_rate_b_rad_s = m.rate_rad_s.z();
    integrator.update(compass_of(m));
    integrator.update(rate);
    take();
  }
  integrator.begin_segment();
  take();
  return readings;
}

/// The gyro known exactly, or unknown.
inline EllipseGyro::Parameters gyro_parameters(bool unknown) {
  EllipseGyro::Parameters parameters;
  parameters.noise_uT = Noise{}.field_uT;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(kPeriod_s);
  if (unknown) return parameters;
  parameters.gyro.mean = {kTrueScale, kTrueBias_rad_s};
  parameters.gyro.covariance = 1e-12 * Eigen::Matrix2d::Identity();
  return parameters;
}

/// As ellipse_bound_deg(), headings tied by the gyro with its noise: dense information on all unknowns, inverted
/// as it is.
inline double gyro_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth, bool unknown) {
  const auto parameters = gyro_parameters(unknown);
  const Eigen::Index first = EllipseShape::kParameters + 2;  // then the headings
  const auto count = static_cast<Eigen::Index>(path.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(first + count, first + count);
  information.block<2, 2>(5, 5) = parameters.gyro.covariance.inverse();
  const double variance = Noise{}.field_uT * Noise{}.field_uT;
  for (Eigen::Index k = 0; k < count; ++k) {
    const TruePoint& point = path[static_cast<std::size_t>(k)];
    Eigen::Matrix<double, 2, 6> slope;
    slope << EllipseShape::slope(point.heading_rad),
        truth.axes_uT * Eigen::Vector2d(-std::sin(point.heading_rad), -std::cos(point.heading_rad));
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
