// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/effects/effect_changes.h"

#include <cmath>

#include "base/angles.h"
#include "sim/layout/added_mass.h"
#include "sim/layout/rigid_body.h"

namespace navcal::sim::change {
namespace {

double half_range(const config::LayoutThruster& thruster) {
  return std::max(thruster.high - thruster.neutral(), thruster.neutral() - thruster.low);
}

void scale_command(config::LayoutHeard& heard, double factor) { heard.scale *= factor; }

}  // namespace

void thrust_scale(config::LayoutThruster& thruster, Values values) {
  // The thrust, not the torque. T0 - k sqrt(|T0|) u_a is scaled whole when k grows with the root.
  const double factor = 1 + values[0];
  for (double& force : thruster.table_force_N) force *= factor;
  thruster.advance_loss_sqrtN_s_m *= std::sqrt(factor);
  if (factor > 0) thruster.torque_m /= factor;
  for (double& coefficient : thruster.KT) coefficient *= factor;
}

void thruster_offset(config::LayoutThruster& thruster, Values values) {
  thruster.heard.offset += values[0] / 100 * half_range(thruster);
}

void thruster_lag(config::LayoutThruster& thruster, Values values) { thruster.lag_s += values[0]; }

void thruster_dead_band(config::LayoutThruster& thruster, Values values) {
  thruster.dead_band += values[0] / 100 * half_range(thruster);
}

void fin_gain(config::LayoutSurface& surface, Values values) { scale_command(surface.heard, 1 + values[0]); }

void fin_offset(config::LayoutSurface& surface, Values values) {
  surface.heard.offset += values[0] * base::kRadiansPerDegree;
}

void fin_lag(config::LayoutSurface& surface, Values values) { surface.lag_s += values[0]; }

void fin_dead_band(config::LayoutSurface& surface, Values values) {
  surface.dead_band_rad += values[0] * base::kRadiansPerDegree;
}

void ballast_scale(config::LayoutBallast& ballast, Values values) { scale_command(ballast.heard, 1 + values[0]); }

void ballast_offset(config::LayoutBallast& ballast, Values values) { ballast.heard.offset += values[0]; }

void mass_scale(config::LayoutMovingMass& mass, Values values) { scale_command(mass.heard, 1 + values[0]); }

void mass_offset(config::LayoutMovingMass& mass, Values values) { mass.heard.offset += values[0]; }

void dead(config::LayoutHeard& heard, Values values) { scale_command(heard, 1 - values[0]); }

void reversed(config::LayoutHeard& heard, Values values) { scale_command(heard, 1 - 2 * values[0]); }

void damping(config::Layout& layout, std::size_t freedom, Values values) {
  layout.damping.factors[freedom] *= 1 + values[0];
}

void added_mass(config::Layout& layout, std::size_t freedom, Values values) {
  // S M_A S with S = diag(1, .., sqrt(1 + k), .., 1) stays symmetric and positive definite.
  Matrix6 matrix = sim::added_mass(layout);
  const double root = std::sqrt(1 + values[0]);
  const auto i = static_cast<Eigen::Index>(freedom);
  matrix.row(i) *= root;
  matrix.col(i) *= root;
  layout.added_mass.spheroid.reset();
  layout.added_mass.strips = {};
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(layout.added_mass.matrix_kg.data()) = matrix;
}

void weight(config::Layout& layout, Values values) { layout.body.mass_kg += values[0]; }

void buoyancy(config::Layout& layout, Values values) { layout.body.buoyancy_N += values[0]; }

void gravity_shift(config::Layout& layout, Values values) {
  for (std::size_t i = 0; i < 3; ++i) layout.body.gravity_centre_m[i] += values[i];
}

void buoyancy_shift(config::Layout& layout, Values values) {
  for (std::size_t i = 0; i < 3; ++i) layout.body.buoyancy_centre_m[i] += values[i];
}

void yaw_damping(config::Layout& layout, Values values) {
  const std::vector<double> at_rest(layout.moving_masses.size());
  const double yaw_kg_m2 = rigid_body_mass(layout, at_rest)(5, 5) + sim::added_mass(layout)(5, 5);
  layout.damping.linear[35] += values[0] * yaw_kg_m2;
}

}  // namespace navcal::sim::change
