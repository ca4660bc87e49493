// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "config/layout.h"
#include "sim/layout/strips.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

/// Forces of the water on the hull without its control surfaces, about the origin, SI, body axes (Fossen 2011,
/// chapter 6), the sum of
/// - linear damping -D nu and quadratic damping -D |nu| nu, element by element;
/// - lift -|u| D nu: what grows with the speed ahead, as Z_uw u w and M_uq u q of a slender hull;
/// - axial drag X = -1/2 rho Cd A |u| u;
/// - body lift Y = -1/2 rho A a |u| v, Z the same with w, acting at x: N += x Y, M -= x Z;
/// - cross-flow drag of the strips (strips.h);
/// - lift and drag in axes of the flow (flow_axes.h);
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
