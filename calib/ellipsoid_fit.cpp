#include "calib/ellipsoid_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

using Pair = Eigen::Vector2d;  // the two lines of the model: size, dip
using Rows = Eigen::Matrix<double, 2, EllipsoidShape::kParameters>;
using Cell = FieldCells<3, 6>::Cell;

constexpr double kOutlier2 = 36;  // six standard deviations of one reading, squared

/// How far a cell is off the model.
struct Departure {
  Pair value;                            // of the cell's readings on the mean
  Eigen::Matrix2d noise;                 // of one reading, so that over the count it is that of their mean
  Eigen::Matrix<double, 2, 3> by_field;  // of the value
  double tilt2 = 0;                      // variance of the tilt, rad2
};

Departure departure_of(const EllipsoidShape& shape, const Cell& cell, const EllipsoidNoise& noise) {
  const Eigen::Matrix3d& m = shape.matrix_per_uT;
  const Eigen::Vector3d down = cell.mean.tail<3>();
  const Eigen::Vector3d unit = m * (cell.mean.head<3>() - shape.centre_uT);
  const double size = std::max(unit.norm(), 1e-6);
  const Eigen::Vector3d direction = unit / size;

  Departure d;
  d.by_field << (m * direction).transpose(), (m * down).transpose();
  // Readings on a curved surface: their mean lies inside it.
  const Eigen::Matrix3d spread = m.lazyProduct(cell.scatter.topLeftCorner<3, 3>() / cell.count).lazyProduct(m);
  const double sagitta = 0.5 * (spread.trace() - direction.dot(spread * direction)) / size;
  const double joint = m.cwiseProduct(cell.scatter.topRightCorner<3, 3>()).sum() / cell.count;
  d.value = {size + sagitta - 1, down.dot(unit) + joint - shape.sine_of_dip};
  d.noise = noise.field_uT * noise.field_uT * d.by_field.lazyProduct(d.by_field.transpose());
  if (down.isZero(0)) {
    d.value[1] = 0;  // tilt was not known: the first line alone
    d.noise = Eigen::Vector2d(d.noise(0, 0), 1).asDiagonal();
    return d;
  }
  // The lag of an inclinometer and the vehicle's accelerations are the same in all readings of a cell: there the
  // tilt is known no better than by one of them.
  d.tilt2 = cell.count * noise.tilt_rad * noise.tilt_rad;
  d.noise(1, 1) += d.tilt2 * std::max(0.01, 1 - shape.sine_of_dip * shape.sine_of_dip);
  return d;
}

/// Of the value by the parameters, at the reading less what of its noise the departure itself reveals: slopes that
/// varied with the noise that they are multiplied with would take a small tilt, with noise, for a larger one, and
/// shift the centre.
Rows slope_of(const EllipsoidShape& shape, const Cell& cell, const EllipsoidNoise& noise, const Departure& d) {
  const Eigen::Matrix3d& m = shape.matrix_per_uT;
  Eigen::Vector3d off_centre = cell.mean.head<3>() - shape.centre_uT;
  Eigen::Vector3d down = cell.mean.tail<3>();
  const bool tilt_known = !down.isZero(0);
  const Pair weighted = d.noise.inverse() * d.value;
  if (tilt_known) {
    const Eigen::Vector3d unit = m * off_centre;
    down -= d.tilt2 * weighted[1] * (unit - down * down.dot(unit));
  }
  if (d.value.dot(weighted) <= kOutlier2)
    off_centre -= noise.field_uT * noise.field_uT * d.by_field.transpose() * weighted;

  const Eigen::Vector3d direction = (m * off_centre).normalized();
  const auto slope = EllipsoidShape::slope_of_matrix(off_centre);
  Rows rows = Rows::Zero();
  rows.row(0) << -(m * direction).transpose(), (slope.transpose() * direction).transpose(), 0;
  if (!tilt_known) return rows;
  const Eigen::Matrix3d with_down = cell.scatter.topRightCorner<3, 3>() / cell.count;
  Eigen::Matrix<double, 6, 1> joint;
  joint << with_down(0, 0), with_down(1, 1), with_down(2, 2), with_down(1, 2) + with_down(2, 1),
      with_down(0, 2) + with_down(2, 0), with_down(0, 1) + with_down(1, 0);
  rows.row(1) << -(m * down).transpose(), (slope.transpose() * down + joint).transpose(), -1;
  return rows;
}

double weight_of(double square) { return square <= kOutlier2 ? 1 : kOutlier2 / square; }
double cost_of(double square) {
  return square <= kOutlier2 ? square : kOutlier2 * (1 + std::log(square / kOutlier2));
}

/// What is known beforehand, as information about the point of linearisation.
struct Known {
  EllipsoidShape::Vector mean = EllipsoidShape::Vector::Zero();  // less the shape
  EllipsoidShape::Vector information = EllipsoidShape::Vector::Zero();

  Known(const EllipsoidShape& shape, const EllipsoidPrior& prior) {
    // Wide enough to say nothing, and what is never seen still has a finite variance.
    constexpr double kAnyCentre_uT = 1e4;
    information.head<3>().setConstant(1 / (kAnyCentre_uT * kAnyCentre_uT));
    information[9] = 1e-2;
    mean[9] = -shape.sine_of_dip;
    mean.head<3>() = -shape.centre_uT;
    if (!prior.known) return;
    const KnownField& field = *prior.known;
    const double cosine = std::max(0.1, std::cos(field.dip_rad));
    mean[9] = std::sin(field.dip_rad) - shape.sine_of_dip;
    information[9] = 1 / (cosine * cosine * field.dip_std_rad * field.dip_std_rad);
    const double magnitude = field.magnitude_std_uT / field.magnitude_uT;
    const double diagonal2 = prior.soft_iron_std * prior.soft_iron_std + magnitude * magnitude;
    const Eigen::Matrix3d& m = shape.matrix_per_uT;
    const double per_uT = 1 / field.magnitude_uT;
    mean.segment<6>(3) << per_uT - m(0, 0), per_uT - m(1, 1), per_uT - m(2, 2), -m(1, 2), -m(0, 2), -m(0, 1);
    information.segment<3>(3).setConstant(1 / (diagonal2 * per_uT * per_uT));
    information.segment<3>(6).setConstant(1 / (prior.soft_iron_std * prior.soft_iron_std * per_uT * per_uT));
  }
  [[nodiscard]] double cost() const { return mean.dot(information.cwiseProduct(mean)); }
};

double total_cost(const EllipsoidShape& shape, const EllipsoidShape& weights, const EllipsoidCells& cells,
                  const EllipsoidNoise& noise, const EllipsoidPrior& prior) {
  double cost = Known(shape, prior).cost();
  for (const Cell& cell : cells) {
    // Weights of the shape from which the step was made: else a large shape would be a good one.
    const Eigen::Matrix2d inverse = departure_of(weights, cell, noise).noise.inverse();
    const Pair value = departure_of(shape, cell, noise).value;
    cost += cell.count * cost_of(value.dot(inverse * value));
  }
  return cost;
}

}  // namespace

EllipsoidFit improve(const EllipsoidFit& fit, const EllipsoidCells& cells, const EllipsoidNoise& noise,
                     const EllipsoidPrior& prior) {
  const Known known(fit.shape, prior);
  EllipsoidShape::Matrix information = known.information.asDiagonal();
  EllipsoidShape::Vector gradient = known.information.cwiseProduct(known.mean);
  double cost = known.cost();
  for (const Cell& cell : cells) {
    const Departure d = departure_of(fit.shape, cell, noise);
    const Rows slope = slope_of(fit.shape, cell, noise, d);
    const Eigen::Matrix2d inverse = d.noise.inverse();
    const double square = d.value.dot(inverse * d.value);
    const Eigen::Matrix<double, EllipsoidShape::kParameters, 2> weighted =
        (cell.count * weight_of(square)) * slope.transpose() * inverse;
    // Too small for the blocked product that Eigen would choose at this size.
    information += weighted.lazyProduct(slope);
    gradient -= weighted * d.value;
    cost += cell.count * cost_of(square);
  }
  // In units of the least certain, so that centre (uT) and matrix (1/uT) meet on equal terms.
  const EllipsoidShape::Vector scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const EllipsoidShape::Matrix scaled =
      scale.asDiagonal() * information * scale.asDiagonal() + 1e-13 * EllipsoidShape::Matrix::Identity().eval();
  const auto solved = [&](double damping, const auto& right) {
    EllipsoidShape::Matrix damped = scaled;
    damped.diagonal() *= 1 + damping;
    return (scale.asDiagonal() * damped.ldlt().solve((scale.asDiagonal() * right).eval())).eval();
  };
  EllipsoidFit next = fit;
  next.covariance = solved(0, EllipsoidShape::Matrix::Identity().eval());
  const EllipsoidShape::Vector step = solved(fit.damping, gradient);
  const EllipsoidShape moved = fit.shape.moved(step);
  // Close to the end the cost no longer tells: the arc within a cell has a slope of its own that is left out here.
  const EllipsoidShape::Vector moved_by = step.cwiseQuotient(next.covariance.diagonal().cwiseSqrt());
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
