// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/symmetric_solve.h"
#include "calib/magnetometer/ellipsoid_fit.h"

namespace navcal::calib {

std::optional<EllipsoidShape> starting_sphere(const EllipsoidCells& cells, const EllipsoidPrior& prior) {
  // |m|^2 - 2 c'm + |c|^2 - r^2 = 0 and down'(m - c) = r sin(dip), linear in c and the two constants; with little
  // tilt the second line is what fixes c along the axis of the cone of readings.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double count = 0, square = 0;
  for (const FieldCells<3, 6>::Cell& cell : cells) {
    count += cell.count;
    mean += cell.count * cell.mean.head<3>();
  }
  if (cells.size() < 4) return std::nullopt;
  mean /= count;
  for (const FieldCells<3, 6>::Cell& cell : cells)
    square += cell.count * (cell.mean.head<3>() - mean).squaredNorm();
  const double size = std::sqrt(square / count);
  if (!(size > 0)) return std::nullopt;

  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  const auto add = [&](double weight, const Eigen::Matrix<double, 5, 1>& row, double value) {
    normal += weight * row * row.transpose();
    right += weight * value * row;
  };
  for (const FieldCells<3, 6>::Cell& cell : cells) {
    const Eigen::Vector3d m = (cell.mean.head<3>() - mean) / size;
    const Eigen::Vector3d down = cell.mean.tail<3>();
    Eigen::Matrix<double, 5, 1> row;
    row << 2 * m, 1, 0;
    add(cell.count, row, m.squaredNorm());
    if (down.isZero(0)) continue;
    row << down, 0, 1;
    add(cell.count, row, down.dot(m));
  }
  const double magnitude = prior.known ? prior.known->magnitude_uT / size : 0;
  if (prior.known) {
    Eigen::Matrix<double, 5, 1> row;
    row << 0, 0, 0, 0, 1;
    add(count, row, magnitude * std::sin(prior.known->dip_rad));
  }
  normal.diagonal().array() += 1e-6 * count;
  const Eigen::Matrix<double, 5, 1> solution = base::solve_symmetric(normal, right);
  const Eigen::Vector3d centre = solution.head<3>();
  double radius = std::sqrt(std::max(solution[3] + centre.squaredNorm(), 0.01));
  if (prior.known) radius = magnitude;
  EllipsoidShape shape;
  shape.centre_uT = mean + size * centre;
  shape.matrix_per_uT = Eigen::Matrix3d::Identity() / (size * radius);
  shape.sine_of_dip = prior.known ? std::sin(prior.known->dip_rad) : std::clamp(solution[4] / radius, -0.99, 0.99);
  return shape.sane() ? std::optional(shape) : std::nullopt;
}

}  // namespace navcal::calib
