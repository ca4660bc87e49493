// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/symmetric_solve.h"

namespace navcal::calib {
namespace {

using ChainVector = EllipseChain::Vector;
using ChainMatrix = EllipseChain::Matrix;

/// The headings are eliminated from first to last: after that, heading k = right - coupling'(shape, gyro)
/// - off * heading k+1, all divided by the pivot.
struct Elimination {
  struct Row {
    double pivot = 0, off = 0, right = 0;
    ChainVector coupling = ChainVector::Zero();
  };
  std::vector<Row> rows;
  ChainMatrix information = ChainMatrix::Zero();
  ChainVector gradient = ChainVector::Zero();
};

double turn_variance(const TurnGroup& from, const TurnGroup& to, double scale, double density) {
  constexpr double kFloor = 1e-12;  // a microradian: two readings at once, or a gyro without noise
  return scale * scale * density * density * std::max(to.time_s - from.time_s, 0.0) + kFloor;
}

ChainVector turn_slope(const TurnGroup& from, const TurnGroup& to) {
  ChainVector slope = ChainVector::Zero();
  slope[5] = to.measured_angle_rad - from.measured_angle_rad;
  slope[6] = to.bias_time_s - from.bias_time_s;
  return slope;
}

Elimination eliminate(const EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief,
                      const ChainNoise& noise) {
  Elimination e;
  e.rows.resize(groups.size());
  const Eigen::Matrix2d gyro_information = belief.covariance.inverse();
  e.information.bottomRightCorner<2, 2>() = gyro_information;
  e.gradient.tail<2>() = gyro_information * (belief.mean - chain.gyro);
  // Readings, and the way to each from the one before.
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const TurnGroup& group = groups[k];
    const double weight = group.count / (noise.field_uT * noise.field_uT);
    const auto slope = EllipseShape::slope(chain.headings_rad[k]);
    const Eigen::Vector2d u = EllipseShape::direction(chain.headings_rad[k]);
    const Eigen::Vector2d along = chain.shape.axes_uT * Eigen::Vector2d(u.y(), -u.x());
    const Eigen::Vector2d off = group.field_uT - chain.shape.at(chain.headings_rad[k]);
    Elimination::Row& row = e.rows[k];
    row.pivot += weight * along.squaredNorm() * (1 + chain.damping);
    row.right += weight * along.dot(off);
    row.coupling.head<5>() += weight * slope.transpose() * along;
    e.information.topLeftCorner<5, 5>() += weight * slope.transpose() * slope;
    e.gradient.head<5>() += weight * slope.transpose() * off;
    if (group.begins_segment || k == 0) continue;
    const TurnGroup& before = groups[k - 1];
    const double link = 1 / turn_variance(before, group, belief.mean[0], noise.rate_rad_sqrt_s);
    const double left = chain.headings_rad[k] - chain.headings_rad[k - 1] - turn_rad(before, group, chain.gyro);
    const ChainVector by_gyro = turn_slope(before, group);
    Elimination::Row& last = e.rows[k - 1];
    row.pivot += link;
    last.pivot += link;
    last.off = -link;
    row.right -= link * left;
    last.right += link * left;
    row.coupling -= link * by_gyro;
    last.coupling += link * by_gyro;
    e.information += link * by_gyro * by_gyro.transpose();
    e.gradient += link * left * by_gyro;
  }
  e.information.diagonal() *= 1 + chain.damping;
  for (std::size_t k = 0; k < e.rows.size(); ++k) {
    const Elimination::Row& row = e.rows[k];
    if (row.off != 0) {
      Elimination::Row& next = e.rows[k + 1];
      const double share = row.off / row.pivot;
      next.pivot -= share * row.off;
      next.right -= share * row.right;
      next.coupling -= share * row.coupling;
    }
    e.information -= row.coupling * row.coupling.transpose() / row.pivot;
    e.gradient -= row.coupling * (row.right / row.pivot);
  }
  return e;
}

double squares(const EllipseChain& chain, const std::vector<TurnGroup>& groups, const ChainNoise& noise) {
  double sum = 0;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    sum += groups[k].count * (groups[k].field_uT - chain.shape.at(chain.headings_rad[k])).squaredNorm();
  }
  return sum / (noise.field_uT * noise.field_uT);
}

}  // namespace

double turn_rad(const TurnGroup& from, const TurnGroup& to, const Eigen::Vector2d& gyro) {
  return gyro[0] * (to.measured_angle_rad - from.measured_angle_rad) +
         gyro[1] * (to.bias_time_s - from.bias_time_s) + (to.tilt_angle_rad - from.tilt_angle_rad);
}

double cost_of(const EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief,
               const ChainNoise& noise) {
  double sum = squares(chain, groups, noise);
  for (std::size_t k = 1; k < groups.size(); ++k) {
    if (groups[k].begins_segment) continue;
    const double left =
        chain.headings_rad[k] - chain.headings_rad[k - 1] - turn_rad(groups[k - 1], groups[k], chain.gyro);
    sum += left * left / turn_variance(groups[k - 1], groups[k], belief.mean[0], noise.rate_rad_sqrt_s);
  }
  const Eigen::Vector2d departure = chain.gyro - belief.mean;
  return sum + departure.dot(belief.covariance.inverse() * departure);
}

void improve(EllipseChain& chain, const std::vector<TurnGroup>& groups, const GyroBelief& belief,
             const ChainNoise& noise) {
  for (std::size_t k = chain.headings_rad.size(); k < groups.size(); ++k) {
    const bool linked = k > 0 && !groups[k].begins_segment;
    chain.headings_rad.push_back(linked
                                     ? chain.headings_rad[k - 1] + turn_rad(groups[k - 1], groups[k], chain.gyro)
                                     : chain.shape.foot_rad(groups[k].field_uT));
  }
  const Elimination e = eliminate(chain, groups, belief, noise);
  const ChainVector scale = e.information.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const ChainMatrix scaled =
      scale.asDiagonal() * e.information * scale.asDiagonal() + 1e-14 * ChainMatrix::Identity().eval();
  const ChainMatrix inverse = scale.asDiagonal() * base::inverse_symmetric(scaled) * scale.asDiagonal();
  const ChainVector step = inverse * e.gradient;

  EllipseChain moved = chain;
  moved.shape = chain.shape.moved(step.head<5>());
  moved.gyro += step.tail<2>();
  double largest_turn = 0, following = 0;
  for (std::size_t k = groups.size(); k-- > 0;) {
    const Elimination::Row& row = e.rows[k];
    following = (row.right - row.coupling.dot(step) - row.off * following) / row.pivot;
    moved.headings_rad[k] += following;
    largest_turn = std::max(largest_turn, std::abs(following));
  }
  const double before = cost_of(chain, groups, belief, noise);
  const bool better = moved.shape.sane() && cost_of(moved, groups, belief, noise) <= before * (1 + 1e-11) + 1e-9;
  const double damping = chain.damping;
  if (better) {
    chain = std::move(moved);
    chain.damping = damping > 1e-6 ? damping / 10 : 0;
  } else {
    chain.damping = std::min(std::max(10 * damping, 1e-3), 1e8);
  }
  chain.settled = better && damping == 0 && largest_turn < 1e-11 &&
                  step.head<5>().cwiseAbs().maxCoeff() < 1e-11 * chain.shape.axes_uT.trace();
  if (damping == 0) chain.covariance = inverse;
  // Each heading takes one of a reading's two components, each link and each belief gives one back.
  double freedom = -EllipseShape::kParameters;
  for (const TurnGroup& group : groups) freedom += group.begins_segment ? 1 : 2;
  chain.misfit = cost_of(chain, groups, belief, noise) / std::max(freedom, 1.0);
  chain.residual_uT = noise.field_uT * std::sqrt(chain.misfit);
}

}  // namespace navcal::calib
