// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/damping.h"

#include <cmath>

#include "sim/layout/flow_axes.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {
namespace {

std::optional<Matrix6> unless_zero(const Matrix6& matrix) {
  return matrix.isZero(0) ? std::nullopt : std::optional(matrix);
}

std::optional<Matrix6> beside_diagonal(Matrix6 matrix) {
  matrix.diagonal().setZero();
  return unless_zero(matrix);
}

}  // namespace

HullDamping::HullDamping(const config::Layout& layout)
    : linear_diagonal_(matrix_of(layout.damping.linear).diagonal()),
      quadratic_diagonal_(matrix_of(layout.damping.quadratic).diagonal()),
      linear_(beside_diagonal(matrix_of(layout.damping.linear))),
      quadratic_(beside_diagonal(matrix_of(layout.damping.quadratic))),
      lift_(unless_zero(matrix_of(layout.damping.lift))),
      axial_kg_m_(0.5 * layout.water_density_kg_m3 * layout.damping.axial_coefficient *
                  layout.damping.axial_area_m2),
      body_lift_kg_m_(0.5 * layout.water_density_kg_m3 * layout.damping.body_lift_area_m2 *
                      layout.damping.body_lift_slope_per_rad),
      body_lift_at_m_(layout.damping.body_lift_at_m),
      strips_(layout.damping.strips, layout.damping.cross_flow_coefficient, layout.water_density_kg_m3),
      flow_axes_(layout.damping.flow_axes) {
  if (layout.damping.factors != config::LayoutDamping{}.factors)
    factors_ = Eigen::Map<const Vector6>(layout.damping.factors.data());
}

Vector6 HullDamping::operator()(const Vector6& velocity) const {
  const double surge = std::abs(velocity[0]);
  const double Y = -body_lift_kg_m_ * surge * velocity[1];
  const double Z = -body_lift_kg_m_ * surge * velocity[2];
  Vector6 force;
  force << -axial_kg_m_ * surge * velocity[0], Y, Z, 0, -body_lift_at_m_ * Z, body_lift_at_m_ * Y;
  force -= (linear_diagonal_ + quadratic_diagonal_.cwiseProduct(velocity.cwiseAbs())).cwiseProduct(velocity);
  if (linear_) force -= *linear_ * velocity;
  if (quadratic_) force -= *quadratic_ * velocity.cwiseAbs().cwiseProduct(velocity);
  if (lift_) force -= surge * (*lift_ * velocity);
  strips_.add(velocity, force);
  if (flow_axes_) force += flow_axes_force(*flow_axes_, velocity);
  if (factors_) force = force.cwiseProduct(*factors_);
  return force;
}

}  // namespace navcal::sim
