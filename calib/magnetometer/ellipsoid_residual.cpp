// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_residual.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

using Cell = EllipsoidCells::value_type;
constexpr double kReadingOutlier2 = 36;  // six standard deviations of one reading, squared

}  // namespace

EllipsoidResidual residual_of(const EllipsoidShape& shape, const Cell& cell, const EllipsoidNoise& noise) {
  const Eigen::Matrix3d& m = shape.matrix_per_uT;
  const Eigen::Vector3d down = cell.mean.tail<3>();
  const Eigen::Vector3d unit = m * (cell.mean.head<3>() - shape.centre_uT);
  const double size = std::max(unit.norm(), 1e-6);
  const Eigen::Vector3d direction = unit / size;

  EllipsoidResidual r;
  r.tilt_known = !down.isZero(0);
  r.by_field << (m * direction).transpose(), (m * down).transpose();
  // Readings on a curved surface: their mean lies inside it.
  const Eigen::Matrix3d spread = m.lazyProduct(cell.scatter.topLeftCorner<3, 3>() / cell.count).lazyProduct(m);
  const double sagitta = 0.5 * (spread.trace() - direction.dot(spread * direction)) / size;
  const double joint = m.cwiseProduct(cell.scatter.topRightCorner<3, 3>()).sum() / cell.count;
  r.value = {size + sagitta - 1, down.dot(unit) + joint - shape.sine_of_dip};
  const double field2 = noise.field_uT * noise.field_uT * noise.field_inflation;
  r.noise = field2 * r.by_field.lazyProduct(r.by_field.transpose());
  if (!r.tilt_known) {
    r.value[1] = 0;  // the first line alone
    r.noise = Eigen::Vector2d(r.noise(0, 0), 1).asDiagonal();
    return r;
  }
  r.tilt2 = noise.tilt_rad * noise.tilt_rad * noise.tilt_inflation;
  r.noise(1, 1) += r.tilt2 * std::max(0.01, 1 - shape.sine_of_dip * shape.sine_of_dip);
  return r;
}

EllipsoidRows slope_of(const EllipsoidShape& shape, const Cell& cell, const EllipsoidNoise& noise,
                       const EllipsoidResidual& residual) {
  const Eigen::Matrix3d& m = shape.matrix_per_uT;
  Eigen::Vector3d off_centre = cell.mean.head<3>() - shape.centre_uT;
  Eigen::Vector3d down = cell.mean.tail<3>();
  const Eigen::Vector2d weighted = residual.noise.inverse() * residual.value;
  if (residual.tilt_known) {
    const Eigen::Vector3d unit = m * off_centre;
    down -= residual.tilt2 * weighted[1] * (unit - down * down.dot(unit));
  }
  if (residual.value.dot(weighted) <= kReadingOutlier2) {
    const double field2 = noise.field_uT * noise.field_uT * noise.field_inflation;
    off_centre -= field2 * residual.by_field.transpose() * weighted;
  }
  const Eigen::Vector3d direction = (m * off_centre).normalized();
  const auto slope = EllipsoidShape::slope_of_matrix(off_centre);
  EllipsoidRows rows = EllipsoidRows::Zero();
  rows.row(0) << -(m * direction).transpose(), (slope.transpose() * direction).transpose(), 0;
  if (!residual.tilt_known) return rows;
  const Eigen::Matrix3d with_down = cell.scatter.topRightCorner<3, 3>() / cell.count;
  Eigen::Matrix<double, 6, 1> joint;
  joint << with_down(0, 0), with_down(1, 1), with_down(2, 2), with_down(1, 2) + with_down(2, 1),
      with_down(0, 2) + with_down(2, 0), with_down(0, 1) + with_down(1, 0);
  rows.row(1) << -(m * down).transpose(), (slope.transpose() * down + joint).transpose(), -1;
  return rows;
}

double outlier_weight(double square) { return square <= kReadingOutlier2 ? 1 : kReadingOutlier2 / square; }
double outlier_cost(double square) {
  return square <= kReadingOutlier2 ? square : kReadingOutlier2 * (1 + std::log(square / kReadingOutlier2));
}

}  // namespace navcal::calib
