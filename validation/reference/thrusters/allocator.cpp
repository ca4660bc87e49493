// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/allocator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "validation/reference/thrusters/outputs.h"

namespace navcal::reference::thrusters {
namespace {

constexpr std::array<std::size_t, kAxes> kPriority{2, 5, 0, 3, 1, 4};
constexpr double kLeastIndependent = 0.2;
constexpr double kHeld_rad = 12 * 0.017453292519943295;
constexpr double kMargin = 0.9;  ///< of a thruster's range

Eigen::Index row(std::size_t axis) { return static_cast<Eigen::Index>(axis); }

Eigen::MatrixXd matrix_of(const Plan& plan) {
  Eigen::MatrixXd B(6, static_cast<Eigen::Index>(plan.thrusters.size()));
  for (std::size_t i = 0; i < plan.thrusters.size(); ++i) {
    const PlannedThruster& t = plan.thrusters[i];
    B.col(row(i)) << t.direction,
        t.place_m.cross(t.direction) + t.reaction_sign * t.torque_share * t.torque_arm_m * t.direction;
  }
  return B;
}

/// The part of a row, as a share, that is square to the span of the others (orthonormal rows).
double independent(const Eigen::RowVectorXd& of, const std::vector<Eigen::RowVectorXd>& others,
                   Eigen::RowVectorXd& rest) {
  rest = of;
  for (const Eigen::RowVectorXd& other : others) rest -= rest.dot(other) * other;
  const double norm = of.norm();
  return norm > 1e-9 ? rest.norm() / norm : 0;
}

}  // namespace

Allocator::Allocator(const Plan& plan)
    : thrusters_(plan.thrusters), density_kg_m3_(plan.density_kg_m3), matrix_(matrix_of(plan)) {
  std::vector<Eigen::RowVectorXd> span;
  for (const std::size_t axis : kPriority) {
    Eigen::RowVectorXd rest;
    commanded_[axis] = independent(matrix_.row(row(axis)), span, rest) > kLeastIndependent;
    if (commanded_[axis]) span.push_back(rest.normalized());
  }
  Eigen::MatrixXd commanded = matrix_;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (!commanded_[axis]) commanded.row(row(axis)).setZero();
  }
  inverse_ = commanded.completeOrthogonalDecomposition().pseudoInverse();
  for (const PlannedThruster& thruster : thrusters_)
    range_N_.push_back({kMargin * thruster.bollard_N(thruster.low, density_kg_m3_),
                        kMargin * thruster.bollard_N(thruster.high, density_kg_m3_)});
  for (std::size_t axis = 0; axis < kAxes; ++axis) limits_[axis] = limit_of(plan, axis);
}

double Allocator::limit_of(const Plan& plan, std::size_t axis) const {
  if (!commanded_[axis]) return 0;
  constexpr double kMuch = 1e6;
  Wrench wanted = Wrench::Zero();
  wanted(row(axis)) = kMuch;
  const Eigen::VectorXd thrusts = thrusts_of(wanted), none = Eigen::VectorXd::Zero(thrusts.size());
  double limit = kMuch * std::min(room(none, thrusts), room(none, -thrusts));
  const Wrench gained = matrix_ * thrusts;
  const double arm_Nm =
      plan.mass_kg * kGravity_m_s2 * plan.gravity_centre_m.z() - plan.buoyancy_N * plan.buoyancy_centre_m.z();
  for (const Eigen::Index turned : {3, 4}) {
    if (commanded_[static_cast<std::size_t>(turned)] || std::abs(gained(turned)) < 1e-6 * kMuch) continue;
    limit = std::min(limit, std::max(arm_Nm, 0.0) * std::sin(kHeld_rad) * kMuch / std::abs(gained(turned)));
  }
  return limit;
}

Eigen::VectorXd Allocator::thrusts_of(const Wrench& wanted) const { return inverse_ * wanted; }

double Allocator::room(const Eigen::VectorXd& base, const Eigen::VectorXd& further) const {
  double share = 1;
  for (std::size_t i = 0; i < range_N_.size(); ++i) {
    const double step = further(row(i));
    const double left = step > 0 ? range_N_[i][1] - base(row(i)) : range_N_[i][0] - base(row(i));
    if (step != 0) share = std::min(share, std::max(left / step, 0.0));
  }
  return share;
}

int Allocator::pulse_us(std::size_t thruster, double thrust_N) const {
  const PlannedThruster& t = thrusters_[thruster];
  // Thrust grows with the pulse: the first whole microsecond that gives more, or the one before it.
  int low = static_cast<int>(std::ceil(pulse_of(t, t.low))), high = static_cast<int>(pulse_of(t, t.high));
  const auto thrust_at = [&](int pulse) { return t.bollard_N(command_of(t, pulse), density_kg_m3_); };
  if (thrust_N == 0) return static_cast<int>(std::lround(pulse_of(t, t.neutral())));
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (thrust_at(middle) < thrust_N ? low : high) = middle;
  }
  return std::abs(thrust_at(low) - thrust_N) < std::abs(thrust_at(high) - thrust_N) ? low : high;
}

std::vector<int> Allocator::pulses_us(const Wrench& wanted) const {
  Wrench held = wanted, moved = Wrench::Zero();
  moved.head<2>() = wanted.head<2>();
  held.head<2>().setZero();
  Eigen::VectorXd thrusts = thrusts_of(held);
  thrusts *= room(Eigen::VectorXd::Zero(thrusts.size()), thrusts);
  const Eigen::VectorXd further = thrusts_of(moved);
  thrusts += room(thrusts, further) * further;
  std::vector<int> pulses;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) pulses.push_back(pulse_us(i, thrusts(row(i))));
  return pulses;
}

}  // namespace navcal::reference::thrusters
