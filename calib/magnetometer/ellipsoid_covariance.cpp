// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/angles.h"
#include "calib/magnetometer/ellipsoid_judgement.h"
#include "calib/magnetometer/ellipsoid_residual.h"

namespace navcal::calib {
namespace {

constexpr double kKind = 0.35;       // readings err together whose fields are within twenty degrees
constexpr double kLeastFreedom = 4;  // fewer kinds beyond the parameters do not tell a misfit

/// Readings of one kind, whatever the line: their weighted residuals and slopes.
struct Kind {
  Eigen::Vector2d weight = Eigen::Vector2d::Zero();  // sums of weights of both lines, taken as independent
  Eigen::Vector2d value = Eigen::Vector2d::Zero();   // weighted sums of residuals
  Eigen::Matrix<double, EllipsoidShape::kParameters, 2> slope =
      Eigen::Matrix<double, EllipsoidShape::kParameters, 2>::Zero();
};

struct Sums {
  std::map<std::array<int, 3>, Kind> kinds;
  // Of slopes by offsets of roll and pitch: with those of the parameters, with each other, with the residuals.
  EllipsoidError::ByTilt with_parameters = EllipsoidError::ByTilt::Zero();
  Eigen::Matrix2d with_tilt = Eigen::Matrix2d::Zero();
  Eigen::Vector2d with_value = Eigen::Vector2d::Zero();
};

Sums sums_of(const EllipsoidFit& fit, const EllipsoidCells& cells, const EllipsoidNoise& noise) {
  Sums sums;
  for (const auto& cell : cells) {
    const Eigen::Vector3d direction = fit.shape.unit_field(cell.mean.head<3>()).normalized();
    std::array<int, 3> key{};
    for (int i = 0; i < 3; ++i)
      key[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(direction[i] / kKind));
    const EllipsoidResidual r = residual_of(fit.shape, cell, noise);
    const EllipsoidRows slope = slope_of(fit.shape, cell, noise, r);
    const double count = cell.count * outlier_weight(r.square());
    Kind& kind = sums.kinds[key];
    for (int line = 0; line < (r.tilt_known ? 2 : 1); ++line) {
      const double weight = count / r.noise(line, line);
      kind.weight[line] += weight;
      kind.value[line] += weight * r.value[line];
      kind.slope.col(line) += weight * slope.row(line).transpose();
    }
    if (!r.tilt_known) continue;
    // down + offset x down in place of down
    const Eigen::Vector2d by_offset =
        cell.mean.tail<3>().cross(fit.shape.unit_field(cell.mean.head<3>())).head<2>();
    const Eigen::Vector2d weight = count * r.noise.inverse().col(1);
    sums.with_parameters += slope.transpose() * weight * by_offset.transpose();
    sums.with_tilt += weight[1] * by_offset * by_offset.transpose();
    sums.with_value += weight.dot(r.value) * by_offset;
  }
  return sums;
}

/// Mean square of the inclinometer's offset, which the fit leaves at zero: its variance and the square of its
/// mean, by the readings and the prior.
Eigen::Matrix2d tilt_offset_square(const EllipsoidFit& fit, const Sums& sums) {
  constexpr double kLeast_rad = 0.2 * base::kRadiansPerDegree, kMost_rad = 1 * base::kRadiansPerDegree;
  const Eigen::Vector2d alike(fit.shape.matrix_per_uT(1, 2), fit.shape.matrix_per_uT(0, 2));
  const Eigen::Vector2d std_rad =
      (alike * fit.shape.radius_uT()).cwiseAbs().cwiseMax(kLeast_rad).cwiseMin(kMost_rad);
  const Eigen::Matrix2d prior = std_rad.cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::Matrix2d absorbed = sums.with_parameters.transpose() * fit.covariance * sums.with_parameters;
  const Eigen::Matrix2d variance = (sums.with_tilt - absorbed + prior).inverse();
  const Eigen::Vector2d mean = variance * sums.with_value;
  return variance + mean * mean.transpose();
}

}  // namespace

EllipsoidError stated_error(const EllipsoidFit& fit, const EllipsoidCells& cells, const EllipsoidNoise& noise,
                            double least_misfit) {
  const Sums sums = sums_of(fit, cells, noise);
  double square = 0, weights = 0, lines = 0;
  for (const auto& [key, kind] : sums.kinds) {
    for (int line = 0; line < 2; ++line) {
      if (!(kind.weight[line] > 0)) continue;
      square += kind.value[line] * kind.value[line] / kind.weight[line];
      weights += kind.weight[line];
      lines += 1;
    }
  }
  const double freedom = lines - EllipsoidShape::kParameters;
  double misfit2 = least_misfit * least_misfit;
  // The parameters absorb a share of the misfit.
  if (freedom >= kLeastFreedom) misfit2 = std::max(misfit2, (square - freedom) / weights * lines / freedom);
  EllipsoidShape::Matrix covariance = fit.covariance;
  for (const auto& [key, kind] : sums.kinds) {
    const auto moved = (fit.covariance * kind.slope).eval();
    covariance += misfit2 * moved * moved.transpose();
  }
  // Where the tilt is slight, noise of the regressors shifts the vertical offset to second order, which the
  // information does not contain: on simulated missions the errors are up to 1.6 of those of first order.
  constexpr double kSlight_uT = 0.5, kShift = 0.6;
  const double larger = 1 + kShift * std::min(1.0, std::sqrt(fit.covariance(2, 2)) / kSlight_uT);
  covariance.row(2) *= larger;
  covariance.col(2) *= larger;
  return {covariance, -fit.covariance * sums.with_parameters, tilt_offset_square(fit, sums)};
}

}  // namespace navcal::calib
