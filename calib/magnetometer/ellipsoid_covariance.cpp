// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

std::map<std::array<int, 3>, Kind> kinds_of(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                            const EllipsoidNoise& noise) {
  std::map<std::array<int, 3>, Kind> kinds;
  for (const auto& cell : cells) {
    const Eigen::Vector3d direction = fit.shape.unit_field(cell.mean.head<3>()).normalized();
    std::array<int, 3> key{};
    for (int i = 0; i < 3; ++i)
      key[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(direction[i] / kKind));
    const EllipsoidResidual r = residual_of(fit.shape, cell, noise);
    const EllipsoidRows slope = slope_of(fit.shape, cell, noise, r);
    const double count = cell.count * outlier_weight(r.square());
    Kind& kind = kinds[key];
    for (int line = 0; line < (r.tilt_known ? 2 : 1); ++line) {
      const double weight = count / r.noise(line, line);
      kind.weight[line] += weight;
      kind.value[line] += weight * r.value[line];
      kind.slope.col(line) += weight * slope.row(line).transpose();
    }
  }
  return kinds;
}

}  // namespace

EllipsoidShape::Matrix stated_covariance(const EllipsoidFit& fit, const EllipsoidCells& cells,
                                         const EllipsoidNoise& noise, double least_misfit) {
  const auto kinds = kinds_of(fit, cells, noise);
  double square = 0, weights = 0, sums = 0;
  for (const auto& [key, kind] : kinds) {
    for (int line = 0; line < 2; ++line) {
      if (!(kind.weight[line] > 0)) continue;
      square += kind.value[line] * kind.value[line] / kind.weight[line];
      weights += kind.weight[line];
      sums += 1;
    }
  }
  const double freedom = sums - EllipsoidShape::kParameters;
  double misfit2 = least_misfit * least_misfit;
  // The parameters absorb a share of the misfit.
  if (freedom >= kLeastFreedom) misfit2 = std::max(misfit2, (square - freedom) / weights * sums / freedom);
  EllipsoidShape::Matrix covariance = fit.covariance;
  for (const auto& [key, kind] : kinds) {
    const auto moved = (fit.covariance * kind.slope).eval();
    covariance += misfit2 * moved * moved.transpose();
  }
  // Where the tilt is slight, noise of the regressors shifts the vertical offset to second order, which the
  // information does not contain: on simulated missions the errors are up to 1.6 of those of first order.
  constexpr double kSlight_uT = 0.5, kShift = 0.6;
  const double larger = 1 + kShift * std::min(1.0, std::sqrt(fit.covariance(2, 2)) / kSlight_uT);
  covariance.row(2) *= larger;
  covariance.col(2) *= larger;
  return covariance;
}

}  // namespace navcal::calib
