// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/symmetric_solve.h"
#include "calib/magnetometer/ellipse_shape.h"

namespace navcal::calib {
namespace {

constexpr double kOutlier = 6;      // cells further off, in standard deviations of one reading, count less
constexpr double kPriorCount = 20;  // weight of the prior noise

struct Distance {
  double distance_uT = 0;
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();  // its u
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
};

Distance distance_of(const EllipseShape& shape, const EllipseCells::value_type& cell) {
  Distance result;
  result.foot = shape.foot(cell.mean.head<2>());
  const Eigen::Vector2d& u = result.foot;
  const Eigen::Vector2d along = shape.axes_uT * Eigen::Vector2d(u.y(), -u.x());
  const double speed = along.norm();
  const Eigen::Vector2d tangent = along / speed;
  result.normal = (shape.axes_uT.inverse() * u).normalized();
  // The mean of readings on an arc lies on its inner side by half the curvature times their variance along it.
  const double curvature = shape.axes_uT.determinant() / (speed * speed * speed);
  const double along_uT2 = tangent.dot(cell.scatter.topLeftCorner<2, 2>() * tangent) / cell.count;
  result.distance_uT =
      result.normal.dot(cell.mean.head<2>() - shape.centre_uT - shape.axes_uT * u) + 0.5 * curvature * along_uT2;
  return result;
}

/// Squares of cells far off grow no further (a redescending weight): an outlier has a cell of its own.
double weight_of(double distance_uT, double scale_uT) {
  const double limit = kOutlier * scale_uT;
  return std::abs(distance_uT) <= limit ? 1.0 : limit * limit / (distance_uT * distance_uT);
}

double cost_of(double distance_uT, double scale_uT) {
  const double limit2 = kOutlier * kOutlier * scale_uT * scale_uT;
  const double square = distance_uT * distance_uT;
  return square <= limit2 ? square : limit2 * (1 + std::log(square / limit2));
}

double total_cost(const EllipseShape& shape, const EllipseCells& cells, double scale_uT) {
  double cost = 0;
  for (const auto& cell : cells) cost += cell.count * cost_of(mean_distance_uT(shape, cell), scale_uT);
  return cost;
}

/// Sums over all cells for one iteration: normal equations, cost and residuals.
struct Sums {
  EllipseShape::Matrix information = EllipseShape::Matrix::Zero();
  EllipseShape::Vector gradient = EllipseShape::Vector::Zero();
  double cost = 0, count = 0, square = 0;
  std::array<double, kSharedSectors> sector_count{}, sector_sum{};

  Sums(const EllipseShape& shape, const EllipseCells& cells, double scale_uT) {
    for (const auto& cell : cells) {
      const Distance d = distance_of(shape, cell);
      const double weight = cell.count * weight_of(d.distance_uT, scale_uT);
      const EllipseShape::Vector row = EllipseShape::slope(d.foot).transpose() * d.normal;
      information += weight * row * row.transpose();
      gradient += weight * d.distance_uT * row;
      cost += cell.count * cost_of(d.distance_uT, scale_uT);
      count += weight;
      square += weight * (d.distance_uT * d.distance_uT +
                          d.normal.dot(cell.scatter.topLeftCorner<2, 2>() * d.normal) / cell.count);
      const double turns = std::atan2(-d.foot.y(), d.foot.x()) / (2 * std::numbers::pi);
      const auto sector = static_cast<std::size_t>((turns - std::floor(turns)) * kSharedSectors) % kSharedSectors;
      sector_count[sector] += weight;
      sector_sum[sector] += weight * d.distance_uT;
    }
  }

  [[nodiscard]] double misfit(double variance_uT2) const {
    double sectors = 0, square_sum = 0;
    for (std::size_t i = 0; i < kSharedSectors; ++i) {
      if (sector_count[i] < 3) continue;
      sectors += 1;
      square_sum += sector_sum[i] * sector_sum[i] / sector_count[i];
    }
    const double freedom = sectors - EllipseShape::kParameters;
    return freedom > 2 ? square_sum / (freedom * variance_uT2) : 1;
  }
};

}  // namespace

double mean_distance_uT(const EllipseShape& shape, const EllipseCells::value_type& cell) {
  return distance_of(shape, cell).distance_uT;
}

EllipseFit improve(const EllipseFit& fit, const EllipseCells& cells, double noise_uT) {
  const double scale = std::max(fit.residual_uT, noise_uT);
  const Sums sums(fit.shape, cells, scale);
  EllipseFit next = fit;
  const double variance = (kPriorCount * noise_uT * noise_uT + sums.square) /
                          std::max(kPriorCount + sums.count - EllipseShape::kParameters, 1.0);
  next.residual_uT = std::sqrt(variance);
  next.misfit = sums.misfit(variance);
  // A ridge of one reading in a hundred thousand, so that what is not seen has a large variance and no division
  // by zero.
  const EllipseShape::Matrix ridge = 1e-9 * sums.count * EllipseShape::Matrix::Identity();
  next.covariance = variance * base::inverse_symmetric(sums.information + ridge);

  EllipseShape::Matrix damped = sums.information + ridge;
  damped.diagonal() *= 1 + fit.damping;
  const EllipseShape::Vector step = base::solve_symmetric(damped, sums.gradient);
  const EllipseShape moved = fit.shape.moved(step);
  // Close to the end the cost no longer tells: the arc within a cell has a slope of its own that is left out here.
  const bool close = fit.damping == 0 && step.cwiseAbs().maxCoeff() < 1e-3 * fit.shape.axes_uT.trace();
  const bool better =
      moved.sane() && (close || total_cost(moved, cells, scale) <= sums.cost * (1 + 1e-12) + 1e-18 * sums.count);
  if (better) {
    next.shape = moved;
    next.damping = fit.damping > 1e-6 ? fit.damping / 10 : 0;
  } else {
    next.damping = std::min(std::max(10 * fit.damping, 1e-4), 1e8);
  }
  next.settled = better && fit.damping == 0 && step.cwiseAbs().maxCoeff() < 1e-12 * fit.shape.axes_uT.trace() &&
                 std::abs(next.residual_uT - fit.residual_uT) < 1e-12 * next.residual_uT;
  return next;
}

}  // namespace navcal::calib
