// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/symmetric_solve.h"
#include "calib/magnetometer/ellipse_chain.h"
#include "calib/magnetometer/ellipse_fit.h"

namespace navcal::calib {
namespace {

constexpr ChainNoise kRough{1, 0.01};  // to compare two beginnings, neither of which is near its end

/// Headings by the ellipse, unwound by the believed gyro; scale and bias by least squares on them.
bool start_from_ellipse(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief) {
  EllipseCells cells;
  for (const TurnGroup& group : groups) {
    EllipseCells::value_type cell;
    cell.count = group.count;
    cell.mean << group.field_uT, group.vertical;
    cells.push_back(cell);
  }
  const auto shape = taubin_ellipse(cells);
  if (!shape) return false;
  chain.shape = *shape;
  chain.headings_rad.clear();
  Eigen::Matrix2d normal = belief.covariance.inverse();
  Eigen::Vector2d right = normal * belief.mean;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    double heading = shape->foot_rad(groups[k].field_uT);
    if (k > 0 && !groups[k].begins_segment) {
      const double before = chain.headings_rad[k - 1];
      const double expected = before + turn_rad(groups[k - 1], groups[k], belief.mean);
      heading = expected + std::remainder(heading - expected, 2 * std::numbers::pi);
      // Differences, because the segments' first headings are unknowns of their own.
      const Eigen::Vector2d row(groups[k].measured_angle_rad - groups[k - 1].measured_angle_rad,
                                groups[k].bias_time_s - groups[k - 1].bias_time_s);
      const double turned = heading - before - (groups[k].tilt_angle_rad - groups[k - 1].tilt_angle_rad);
      const double weight = 1e4;  // a hundredth of a radian each
      normal += weight * row * row.transpose();
      right += weight * turned * row;
    }
    chain.headings_rad.push_back(heading);
  }
  chain.gyro = base::solve_symmetric(normal, right);
  return chain.gyro.allFinite();
}

/// Headings by the believed gyro from an unknown first one: field = centre + T u(turned), linear; T = S times a
/// rotation by that first heading (polar decomposition). Of the longest segment.
bool start_from_gyro(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief) {
  std::size_t begin = 0, length = 0;
  for (std::size_t k = 0, first = 0; k < groups.size(); ++k) {
    if (groups[k].begins_segment) first = k;
    if (k + 1 - first > length) {
      begin = first;
      length = k + 1 - first;
    }
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t k = begin; k < begin + length; ++k) {
    const Eigen::Vector2d u = EllipseShape::direction(turn_rad(groups[begin], groups[k], belief.mean));
    const Eigen::Vector3d row(1, u.x(), u.y());
    normal += groups[k].count * row * row.transpose();
    right += groups[k].count * row * groups[k].field_uT.transpose();
  }
  const Eigen::Matrix<double, 3, 2> solution = base::solve_symmetric(normal, right);
  const Eigen::Matrix2d turned_axes = solution.bottomRows<2>().transpose();
  if (!solution.allFinite() || !(turned_axes.determinant() > 0)) return false;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(turned_axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  chain.shape.centre_uT = solution.row(0).transpose();
  chain.shape.axes_uT = svd.matrixU() * svd.singularValues().asDiagonal() * svd.matrixU().transpose();
  if (!chain.shape.sane()) return false;
  const Eigen::Vector2d first = svd.matrixU() * svd.matrixV().transpose() * EllipseShape::direction(0);
  const double first_rad = std::atan2(-first.y(), first.x());
  chain.gyro = belief.mean;
  chain.headings_rad.clear();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    double heading = chain.shape.foot_rad(groups[k].field_uT);
    if (k >= begin && k < begin + length) {
      heading = first_rad + turn_rad(groups[begin], groups[k], belief.mean);
    } else if (k > 0 && !groups[k].begins_segment) {
      heading = chain.headings_rad[k - 1] + turn_rad(groups[k - 1], groups[k], belief.mean);
    }
    chain.headings_rad.push_back(heading);
  }
  return true;
}

}  // namespace

bool start(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief) {
  EllipseChain by_ellipse, by_gyro;
  const bool ellipse = start_from_ellipse(by_ellipse, groups, belief);
  const bool gyro = start_from_gyro(by_gyro, groups, belief);
  if (!ellipse && !gyro) return false;
  const double infinity = std::numeric_limits<double>::infinity();
  const double ellipse_cost = ellipse ? cost_of(by_ellipse, groups, belief, kRough) : infinity;
  const double gyro_cost = gyro ? cost_of(by_gyro, groups, belief, kRough) : infinity;
  chain = ellipse_cost < gyro_cost ? by_ellipse : by_gyro;
  return true;
}

}  // namespace navcal::calib
