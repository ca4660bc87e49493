// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/symmetric_solve.h"
#include "calib/magnetometer/ellipsoid_residual.h"

namespace navcal::calib {
namespace {

using Cell = FieldCells<3, 6>::Cell;
using ShapeVector = EllipsoidShape::Vector;
using Matrix = EllipsoidShape::Matrix;

/// The prior as a mean and an information matrix about the point of linearisation.
struct Known {
  ShapeVector mean = ShapeVector::Zero();  ///< less the shape
  Matrix information = Matrix::Zero();

  Known(const EllipsoidShape& shape, const EllipsoidShape& scale, const EllipsoidPrior& prior) {
    // The prior is wider than any vehicle's iron. It gives components that no reading determines a finite
    // variance.
    constexpr double kAnyCentre_uT = 100;
    information.diagonal().head<3>().setConstant(1 / (kAnyCentre_uT * kAnyCentre_uT));
    information(9, 9) = 1e-2;
    mean[9] = -shape.sine_of_dip;
    mean.head<3>() = -shape.centre_uT;
    const Eigen::Matrix3d& m = shape.matrix_per_uT;
    mean.segment<6>(3) << -m(0, 0), -m(1, 1), -m(2, 2), -m(1, 2), -m(0, 2), -m(0, 1);
    if (prior.known) {
      add(*prior.known, prior.soft_iron_std);
      return;
    }
    // The size is not known, but soft iron is no more than a share of it: M is near a multiple of the unit matrix.
    const double per_uT = scale.matrix_per_uT.trace() / 3;
    const double weight = 1 / (prior.soft_iron_std * prior.soft_iron_std * per_uT * per_uT);
    information.block<3, 3>(3, 3) = weight * (Eigen::Matrix3d::Identity() - Eigen::Matrix3d::Constant(1. / 3));
    information.block<3, 3>(6, 6) = weight * Eigen::Matrix3d::Identity();
  }
  [[nodiscard]] double cost() const { return mean.dot(information * mean); }

 private:
  void add(const KnownField& field, double soft_iron_std) {
    const double cosine = std::max(0.1, std::cos(field.dip_rad));
    mean[9] += std::sin(field.dip_rad);
    information(9, 9) = 1 / (cosine * cosine * field.dip_std_rad * field.dip_std_rad);
    const double magnitude = field.magnitude_std_uT / field.magnitude_uT;
    const double diagonal2 = soft_iron_std * soft_iron_std + magnitude * magnitude;
    const double per_uT = 1 / field.magnitude_uT;
    mean.segment<3>(3).array() += per_uT;
    information.diagonal().segment<3>(3).setConstant(1 / (diagonal2 * per_uT * per_uT));
    information.diagonal().segment<3>(6).setConstant(1 / (soft_iron_std * soft_iron_std * per_uT * per_uT));
  }
};

double total_cost(const EllipsoidShape& shape, const EllipsoidShape& weights, const EllipsoidCells& cells,
                  const EllipsoidNoise& noise, const EllipsoidPrior& prior) {
  double cost = Known(shape, weights, prior).cost();
  for (const Cell& cell : cells) {
    // Weights of the shape from which the step was made: else a large shape would be a good one.
    const Eigen::Matrix2d inverse = residual_of(weights, cell, noise).noise.inverse();
    const Eigen::Vector2d value = residual_of(shape, cell, noise).value;
    cost += cell.count * outlier_cost(value.dot(inverse * value));
  }
  return cost;
}

}  // namespace

EllipsoidFit improve(const EllipsoidFit& fit, const EllipsoidCells& cells, const EllipsoidNoise& noise,
                     const EllipsoidPrior& prior) {
  const Known known(fit.shape, fit.shape, prior);
  Matrix information = known.information;
  ShapeVector gradient = known.information * known.mean;
  double cost = known.cost();
  for (const Cell& cell : cells) {
    const EllipsoidResidual r = residual_of(fit.shape, cell, noise);
    const EllipsoidRows slope = slope_of(fit.shape, cell, noise, r);
    const double square = r.square();
    const Eigen::Matrix<double, EllipsoidShape::kParameters, 2> weighted =
        (cell.count * outlier_weight(square)) * slope.transpose() * r.noise.inverse();
    // Too small for the blocked product that Eigen would choose at this size.
    information += weighted.lazyProduct(slope);
    gradient -= weighted * r.value;
    cost += cell.count * outlier_cost(square);
  }
  // Each parameter is scaled by its own information, so that centre (uT) and matrix (1/uT) are comparable.
  const ShapeVector scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * information * scale.asDiagonal() + 1e-13 * Matrix::Identity().eval();
  const auto solved = [&](double damping, const Eigen::MatrixXd& right) {
    Matrix damped = scaled;
    damped.diagonal() *= 1 + damping;
    return Eigen::MatrixXd(scale.asDiagonal() * base::solve_symmetric(damped, scale.asDiagonal() * right));
  };
  EllipsoidFit next = fit;
  next.covariance = solved(0, Matrix::Identity());
  const ShapeVector step = solved(fit.damping, gradient);
  const EllipsoidShape moved = fit.shape.moved(step);
  // Close to the end the cost no longer tells: the arc within a cell has a slope of its own that is left out here.
  const ShapeVector moved_by = step.cwiseQuotient(next.covariance.diagonal().cwiseSqrt());
  const double moved_most = std::max(step.head<3>().norm() / fit.shape.radius_uT(),
                                     step.segment<6>(3).norm() / fit.shape.matrix_per_uT.norm());
  const bool close = fit.damping == 0 && moved_most < 1e-3;
  const bool better =
      moved.sane() && (close || total_cost(moved, fit.shape, cells, noise, prior) <= cost * (1 + 1e-11) + 1e-12);
  if (better) {
    next.shape = moved;
    next.damping = fit.damping > 1e-6 ? fit.damping / 10 : 0;
  } else {
    next.damping = std::min(std::max(10 * fit.damping, 1e-4), 1e8);
  }
  next.settled = better && fit.damping == 0 && moved_by.cwiseAbs().maxCoeff() < 1e-9;
  return next;
}

}  // namespace navcal::calib
