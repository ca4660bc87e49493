// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Cross-flow drag by strips (Fossen 2011, chapter 6). A strip at x is dx long, w wide and h high.
/// It meets the water with (vl, wl) = (v + x r, w - x q). Its forces are
///   dY = -1/2 rho Cd h sqrt(vl^2 + wl^2) vl dx,   dZ = -1/2 rho Cd w sqrt(vl^2 + wl^2) wl dx,
/// and it adds to the moments
///   N += x dY, M -= x dZ.
class CrossFlowStrips {
 public:
  CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3);

  /// Adds the forces about the origin at this body velocity.
  void add(const Vector6& velocity, Vector6& force) const;

 private:
  /// The processor takes strips two at a time; the last block is filled up with strips without width.
  static constexpr Eigen::Index kBlock = 4;
  using Strips = Eigen::Array<double, kBlock, 1>;
  struct Block {
    Strips x_m = Strips::Zero(), sway_kg_m = Strips::Zero(), heave_kg_m = Strips::Zero();
  };
  std::vector<Block> blocks_;
};

/// Forces of a lifting body about the origin, body axes (Graver 2005, Underwater Gliders: Dynamics, Control and
/// Design, chapter 3). With V the speed, alpha = atan2(w, u), beta = asin(v/V), both held within the stall angle
/// in the coefficients:
///   L = (l0 + l1 alpha) V^2, D = (d0 + d1 alpha^2) V^2, S = -s beta V^2;
///   K = k beta V^2, M = (m0 + m1 alpha) V^2, N = n beta V^2.
/// Drag acts against the velocity, lift across it in the plane of u and w (up in level motion ahead), S along y.
[[nodiscard]] Vector6 flow_axes_force(const config::LayoutFlowAxes& flow, const Vector6& velocity);

/// Forces of the water on the hull without its control surfaces, about the origin, SI, body axes (Fossen 2011,
/// chapter 6), the sum of
/// - linear damping -D nu and quadratic damping -D |nu| nu, element by element;
/// - lift -|u| D nu: what grows with the speed ahead, as Z_uw u w and M_uq u q of a slender hull;
/// - axial drag X = -1/2 rho Cd A |u| u;
/// - body lift Y = -1/2 rho A a |u| v, Z the same with w, acting at x: N += x Y, M -= x Z;
/// - cross-flow drag of the strips;
/// - lift and drag in axes of the flow;
/// times a factor in each degree of freedom.
class HullDamping {
 public:
  explicit HullDamping(const config::Layout& layout);

  [[nodiscard]] Vector6 operator()(const Vector6& velocity) const;

 private:
  Vector6 linear_diagonal_, quadratic_diagonal_;
  /// Beside the diagonals; nullopt where all is zero: most layouts have one of three.
  std::optional<Matrix6> linear_, quadratic_, lift_;
  double axial_kg_m_, body_lift_kg_m_, body_lift_at_m_;
  CrossFlowStrips strips_;
  std::optional<config::LayoutFlowAxes> flow_axes_;
  std::optional<Vector6> factors_;
};

}  // namespace navcal::sim
