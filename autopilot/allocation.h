// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "config/layout.h"

namespace navcal::autopilot {

/// The x within low and high that minimises |A x - b|^2 + eps^2 |x|^2, eps > 0: strictly convex, so it is unique.
/// Primal active-set method (Nocedal and Wright, Numerical Optimization, 2006, section 16.5): solve with the
/// variables that are free; go as far as the first limit and hold that variable there; free the one whose gradient
/// points inwards most; end when none does.
[[nodiscard]] Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double eps,
                                                    const Eigen::VectorXd& low, const Eigen::VectorXd& high);

/// Force and moment X, Y, Z, K, M, N about the origin, N and Nm, or a body velocity u, v, w, p, q, r.
using Wrench = Eigen::Matrix<double, 6, 1>;

/// How a wrench beyond the actuators' limits is approached.
enum class Saturation {
  least_squares,   ///< smallest weighted error
  keep_direction,  ///< the largest part of the wrench that can be had; its direction stays
};

struct AllocationRequest {
  Wrench wanted = Wrench::Zero();
  Wrench velocity = Wrench::Zero();  ///< of the vehicle through the water: surfaces need flow
  Wrench weights = Wrench::Ones();   ///< importance of each component; 0: free
  Saturation saturation = Saturation::keep_direction;
};

struct Allocation {
  std::vector<double> thruster_commands;  ///< within limits, in the command's unit
  std::vector<double> surfaces_rad;       ///< within limits and stall
  Wrench reached = Wrench::Zero();        ///< what thrusts and angles give by the allocation matrix
  double part = 1;                        ///< of the wanted wrench, with Saturation::keep_direction
};

/// Commands of any layout's actuators for a wanted force and moment.
/// Model: tau = B f, a column for each thruster's thrust f (N) with the reaction of its propeller at full command,
/// and one for each movable surface's angle (rad) with the lift that it adds, 1/2 rho A V_c^2 a n at its place.
/// Problem: minimise |W (B f - tau)|^2 + eps^2 |f/f_max|^2 within the limits of thrust at this speed, and of angle
/// and stall (Fossen 2011, section 12.3; Johansen and Fossen 2013). W divides forces by the greatest attainable
/// force and moments by that times the greatest lever. A primal active-set method solves it exactly in a few
/// steps.
class Allocator {
 public:
  explicit Allocator(config::Layout layout);

  /// Takes a thruster or a surface out of use, or back into it. False: there is none of this name.
  bool set_dead(std::string_view name, bool is_dead = true);

  [[nodiscard]] Allocation allocate(const AllocationRequest& request) const;

  /// B at this velocity: thrusters, then surfaces; columns of dead ones are zero.
  [[nodiscard]] Eigen::MatrixXd matrix(const Wrench& velocity) const;
  /// Lowest and highest thrust or angle of each column.
  struct Limits {
    Eigen::VectorXd low, high;
  };
  [[nodiscard]] Limits limits(const Wrench& velocity) const;
  /// Factors of the rows of B that make forces and moments comparable.
  [[nodiscard]] Wrench row_scales(const Eigen::MatrixXd& matrix, const Limits& limits) const;
  [[nodiscard]] const config::Layout& layout() const { return layout_; }

 private:
  [[nodiscard]] Eigen::VectorXd solve(const AllocationRequest& request, const Eigen::MatrixXd& matrix,
                                      const Limits& limits, double part) const;

  config::Layout layout_;
  std::vector<bool> dead_;  ///< thrusters, then surfaces
};

}  // namespace navcal::autopilot
