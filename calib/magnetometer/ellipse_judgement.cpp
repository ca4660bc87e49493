// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_judgement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/symmetric_eigen.h"
#include "calib/coverage.h"
#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/magnetometer/ellipse_shape.h"

namespace navcal::calib {
namespace {

double squares(const EllipseShape& shape, const EllipseCells& cells) {
  double sum = 0;
  for (const auto& cell : cells) {
    const double distance = mean_distance_uT(shape, cell);
    sum += cell.count * distance * distance;
  }
  return sum;
}

}  // namespace

EllipseShape::Matrix stated_covariance(const EllipseFit& fit, const EllipseCells& cells, double model_error_uT) {
  std::array<EllipseShape::Vector, kSharedSectors> sums;
  sums.fill(EllipseShape::Vector::Zero());
  EllipseShape::Vector by_vertical = EllipseShape::Vector::Zero();
  const Eigen::Matrix2d inverse = fit.shape.axes_uT.inverse();
  for (const auto& cell : cells) {
    const Eigen::Vector2d u = fit.shape.foot(cell.mean.head<2>());
    const double turns = std::atan2(-u.y(), u.x()) / (2 * std::numbers::pi);
    const auto sector = static_cast<std::size_t>((turns - std::floor(turns)) * kSharedSectors) % kSharedSectors;
    const Eigen::Vector2d normal = (inverse * u).normalized();
    const EllipseShape::Vector row = cell.count * EllipseShape::slope(u).transpose() * normal;
    sums[sector] += row;
    by_vertical += normal.dot(cell.mean.tail<2>()) * row;
  }
  const EllipseShape::Matrix per_uT2 = fit.covariance / (fit.residual_uT * fit.residual_uT);
  EllipseShape::Matrix covariance = fit.covariance * std::max(1.0, fit.misfit);
  const EllipseShape::Vector vertical = kVerticalOffset_uT * (per_uT2 * by_vertical);
  covariance += vertical * vertical.transpose();
  for (const auto& sum : sums) {
    const EllipseShape::Vector moved = model_error_uT * (per_uT2 * sum);
    covariance += moved * moved.transpose();
  }
  return covariance;
}

MagnetometerEstimate level_estimate(const EllipseShape& shape, const EllipseShape::Matrix& covariance,
                                    double residual_uT, std::uint64_t samples) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  MagnetometerEstimate estimate;
  estimate.correction = correction_of(shape);
  estimate.offset_std_uT << covariance.diagonal().head<2>().cwiseSqrt(), kUnknown;
  estimate.matrix_std.setConstant(kUnknown);
  estimate.residual_uT = residual_uT;
  estimate.field_uT = shape.radius_uT();
  estimate.heading_std_rad = worst_heading_std_rad(shape, covariance);
  estimate.samples = samples;
  return estimate;
}

double curvature_of(const EllipseFit& fit, const EllipseCells& cells) {
  const base::SymmetricEigen eigen = base::symmetric_eigen(fit.covariance);
  constexpr int kLargest = EllipseShape::kParameters - 1;
  const EllipseShape::Vector move = 2 * std::sqrt(eigen.values[kLargest]) * eigen.vectors.col(kLargest);
  const double expected = 4 * fit.residual_uT * fit.residual_uT;
  const double here = squares(fit.shape, cells);
  double worst = 1;
  for (const double side : {-1.0, 1.0}) {
    const EllipseShape moved = fit.shape.moved(side * move);
    if (!moved.sane()) return std::numeric_limits<double>::infinity();
    const double ratio = (squares(moved, cells) - here) / expected;
    worst = std::max({worst, ratio, 1 / std::max(ratio, 1e-9)});
  }
  return worst;
}

template <int N>
double condition_of(const Eigen::Matrix<double, N, N>& covariance) {
  if (!covariance.allFinite() || !(covariance.diagonal().minCoeff() > 0)) {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Matrix<double, N, 1> scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, N, N> scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::VectorXd values = base::symmetric_eigenvalues(scaled);
  const double least = values[0];
  return least > 0 ? values[N - 1] / least : std::numeric_limits<double>::infinity();
}
template double condition_of(const Eigen::Matrix<double, 5, 5>&);
template double condition_of(const Eigen::Matrix<double, 7, 7>&);
template double condition_of(const Eigen::Matrix<double, 10, 10>&);

Judgement EllipseEstimator::judgement() const {
  constexpr double kLeastSize = 30;       // of the ellipse, in residuals
  constexpr double kMostCurvature = 2.5;  // see curvature_of()
  constexpr double kFullTurn_rad = 2 * std::numbers::pi;
  Judgement judgement;
  judgement.samples = samples_;
  judgement.condition = std::numeric_limits<double>::infinity();
  if (!fit_) return judgement.refused("the field has hardly changed", "turn through a full circle");
  judgement.condition = condition_of(fit_->covariance);
  if (fit_->shape.radius_uT() < kLeastSize * fit_->residual_uT) {
    return judgement.refused("the field changed by no more than its noise", "turn through a full circle");
  }
  std::vector<double> headings;
  for (const auto& cell : cells_.cells()) {
    const double limit = 6 * fit_->residual_uT;
    if (std::abs(mean_distance_uT(fit_->shape, cell)) < limit)
      headings.push_back(fit_->shape.foot_rad(cell.mean.head<2>()));
  }
  const FieldCoverage coverage(std::move(headings));
  judgement.coverage = coverage.arc_rad() / kFullTurn_rad;
  if (coverage.arc_rad() < parameters_.least_arc_rad) {
    return judgement.refused("headings within " + whole_degrees(coverage.arc_rad()) +
                                 " degrees do not tell the field's offset from its size",
                             coverage.manoeuvre(parameters_.least_arc_rad));
  }
  const double worst_rad =
      worst_heading_std_rad(fit_->shape, stated_covariance(*fit_, cells_.cells(), parameters_.model_error_uT));
  if (worst_rad >
      accepted_heading_std_rad(parameters_.heading_std_rad, worst_raw_heading_error_rad(fit_->shape))) {
    return judgement.refused("the heading would be uncertain by " +
                                 rounded(worst_rad * (180 / std::numbers::pi), 1) + " degrees where it is worst",
                             coverage.arc_rad() < 0.9 * kFullTurn_rad
                                 ? coverage.manoeuvre(kFullTurn_rad)
                                 : "turn through more full circles, evenly and level");
  }
  if (curvature_of(*fit_, cells_.cells()) > kMostCurvature) {
    return judgement.refused("the readings fit ellipses too different from each other to state an error",
                             coverage.manoeuvre(kFullTurn_rad));
  }
  judgement.accepted = true;
  return judgement;
}

}  // namespace navcal::calib
