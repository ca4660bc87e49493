// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "validation/reference/forces.h"
#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {

/// Surge, sway, heave, roll, pitch, yaw.
inline constexpr std::size_t kAxes = 6;

/// Splits a wanted force and moment among the thrusters of a layout by the pseudo-inverse of its allocation
/// matrix, over those axes that the thrusters can command independently. Axes are taken in the order heave, yaw,
/// surge, roll, sway, pitch; one whose row is nearly a sum of those before it (less than 0.2 of it stands square
/// to them) is left alone. Thrust is taken from the layout at rest.
class Allocator {
 public:
  explicit Allocator(const Plan& plan);

  [[nodiscard]] bool commands(std::size_t axis) const { return commanded_[axis]; }
  /// Greatest force or moment along one commanded axis, both ways, with all thrusters within their limits, and
  /// with an uncommanded roll or pitch moment below what weight and buoyancy hold at 12 degrees. N, Nm.
  [[nodiscard]] double limit(std::size_t axis) const { return limits_[axis]; }
  /// Whole microseconds for each thruster. What is beyond the limits is left out: first of surge and sway.
  [[nodiscard]] std::vector<int> pulses_us(const Wrench& wanted) const;

 private:
  [[nodiscard]] Eigen::VectorXd thrusts_of(const Wrench& wanted) const;
  /// Largest share of `further` that fits within the limits beside `base`; 0 to 1.
  [[nodiscard]] double room(const Eigen::VectorXd& base, const Eigen::VectorXd& further) const;
  [[nodiscard]] int pulse_us(std::size_t thruster, double thrust_N) const;
  [[nodiscard]] double limit_of(const Plan& plan, std::size_t axis) const;

  std::vector<PlannedThruster> thrusters_;
  double density_kg_m3_;
  std::vector<std::array<double, 2>> range_N_;  ///< of each thruster
  Eigen::MatrixXd matrix_;                      ///< wrench of unit thrusts, all six axes
  Eigen::MatrixXd inverse_;                     ///< thrusts of a unit wrench; columns of uncommanded axes are zero
  std::array<bool, kAxes> commanded_{};
  std::array<double, kAxes> limits_{};
};

}  // namespace navcal::reference::thrusters
