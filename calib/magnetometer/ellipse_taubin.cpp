// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>

#include "base/symmetric_eigen.h"
#include "base/symmetric_solve.h"
#include "calib/magnetometer/ellipse_fit.h"

namespace navcal::calib {
namespace {

using Conic = Eigen::Matrix<double, 5, 1>;  // x^2, xy, y^2, x, y; the constant is eliminated
using ConicMatrix = Eigen::Matrix<double, 5, 5>;

struct Frame {
  Eigen::Vector2d origin_uT = Eigen::Vector2d::Zero();
  double scale_uT = 1;
  double count = 0;
};

/// Centre and size of all readings, so that the powers are of order one; nullopt where they have no extent.
std::optional<Frame> frame_of(const EllipseCells& cells) {
  Frame frame;
  for (const auto& cell : cells) {
    frame.count += cell.count;
    frame.origin_uT += cell.count * cell.mean.head<2>();
  }
  if (cells.size() < 5) return std::nullopt;
  frame.origin_uT /= frame.count;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& cell : cells) {
    const Eigen::Vector2d off = cell.mean.head<2>() - frame.origin_uT;
    scatter += cell.count * off * off.transpose();
  }
  const Eigen::Vector2d extent = base::symmetric_eigenvalues(scatter);
  if (!(extent[0] > 1e-8 * extent[1])) return std::nullopt;
  frame.scale_uT = std::sqrt(scatter.trace() / frame.count);
  return frame;
}

/// S and centre of q'[x^2 xy y^2 x y] + constant = 0; nullopt where that is no ellipse.
std::optional<EllipseShape> ellipse_of(const Conic& q, double constant, const Frame& frame) {
  Eigen::Matrix2d form;
  form << q[0], q[1] / 2, q[1] / 2, q[2];
  if (!(form.determinant() > 1e-12 * form.squaredNorm())) return std::nullopt;
  const Eigen::Vector2d centre = -0.5 * form.inverse() * q.tail<2>();
  const double level = centre.dot(form * centre) - constant;
  const base::SymmetricEigen axes = base::symmetric_eigen(form / level);
  if (!(axes.values[0] > 0)) return std::nullopt;
  EllipseShape shape;
  shape.centre_uT = frame.origin_uT + frame.scale_uT * centre;
  shape.axes_uT = frame.scale_uT * axes.vectors * axes.values.cwiseSqrt().cwiseInverse().asDiagonal() *
                  axes.vectors.transpose();
  return shape.sane() ? std::optional(shape) : std::nullopt;
}

/// Circle by linear least squares.
std::optional<EllipseShape> circle(const EllipseCells& cells, const Frame& frame) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& cell : cells) {
    const Eigen::Vector2d x = (cell.mean.head<2>() - frame.origin_uT) / frame.scale_uT;
    const Eigen::Vector3d row(x.x(), x.y(), 1);
    normal += cell.count * row * row.transpose();
    right += cell.count * x.squaredNorm() * row;
  }
  const Eigen::Vector3d solution = base::solve_symmetric(normal, right);
  const Eigen::Vector2d centre = solution.head<2>() / 2;
  EllipseShape shape;
  shape.centre_uT = frame.origin_uT + frame.scale_uT * centre;
  shape.axes_uT = frame.scale_uT * std::sqrt(solution[2] + centre.squaredNorm()) * Eigen::Matrix2d::Identity();
  return shape.sane() ? std::optional(shape) : std::nullopt;
}

}  // namespace

std::optional<EllipseShape> taubin_ellipse(const EllipseCells& cells) {
  const auto frame = frame_of(cells);
  if (!frame) return std::nullopt;
  ConicMatrix values = ConicMatrix::Zero();     // of the form, its mean square about its mean
  ConicMatrix gradients = ConicMatrix::Zero();  // mean square of its gradient
  Conic mean = Conic::Zero();
  for (const auto& cell : cells) {
    const Eigen::Vector2d x = (cell.mean.head<2>() - frame->origin_uT) / frame->scale_uT;
    const double weight = cell.count / frame->count;
    Conic powers, by_x, by_y;
    powers << x.x() * x.x(), x.x() * x.y(), x.y() * x.y(), x.x(), x.y();
    by_x << 2 * x.x(), x.y(), 0, 1, 0;
    by_y << 0, x.x(), 2 * x.y(), 0, 1;
    mean += weight * powers;
    values += weight * powers * powers.transpose();
    gradients += weight * (by_x * by_x.transpose() + by_y * by_y.transpose());
  }
  values -= mean * mean.transpose();
  gradients += 1e-12 * gradients.trace() * ConicMatrix::Identity();
  const base::SymmetricEigen eigen = base::generalized_symmetric_eigen(values, gradients);
  const Conic q = eigen.vectors.col(0);
  if (q.allFinite()) {
    if (auto shape = ellipse_of(q, -q.dot(mean), *frame)) return shape;
  }
  return circle(cells, *frame);
}

}  // namespace navcal::calib
