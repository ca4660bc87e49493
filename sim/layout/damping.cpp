// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/damping.h"

#include <algorithm>
#include <cmath>

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

CrossFlowStrips::CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3) {
  for (std::size_t i = 0; i < strips.x_m.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i) % kBlock;
    if (place == 0) blocks_.emplace_back();
    const double per_width = 0.5 * density_kg_m3 * coefficient * strips.length_m[i];
    blocks_.back().x_m[place] = strips.x_m[i];
    blocks_.back().sway_kg_m[place] = per_width * strips.height_m[i];
    blocks_.back().heave_kg_m[place] = per_width * strips.width_m[i];
  }
}

void CrossFlowStrips::add(const Vector6& velocity, Vector6& force) const {
  const double v = velocity[1], w = velocity[2], q = velocity[4], r = velocity[5];
  Strips Y = Strips::Zero(), Z = Strips::Zero(), M = Strips::Zero(), N = Strips::Zero();
  for (const Block& block : blocks_) {
    const Strips vl = v + r * block.x_m;
    const Strips wl = w - q * block.x_m;
    const Strips speed = (vl.square() + wl.square()).sqrt();
    const Strips across = block.sway_kg_m * speed * vl, down = block.heave_kg_m * speed * wl;
    Y += across;
    Z += down;
    N += block.x_m * across;
    M += block.x_m * down;
  }
  force[1] -= Y.sum();
  force[2] -= Z.sum();
  force[4] += M.sum();
  force[5] -= N.sum();
}

Vector6 flow_axes_force(const config::LayoutFlowAxes& flow, const Vector6& velocity) {
  const Eigen::Vector3d linear = velocity.head<3>();
  const double speed = linear.norm();
  const double in_plane = std::hypot(linear.x(), linear.z());
  Vector6 force = Vector6::Zero();
  constexpr double kLeast_m_s = 1e-9;
  if (!(speed > kLeast_m_s)) return force;
  const auto held = [&](double angle) { return std::clamp(angle, -flow.stall_rad, flow.stall_rad); };
  const double alpha = held(std::atan2(linear.z(), linear.x()));
  const double beta = held(std::asin(std::clamp(linear.y() / speed, -1.0, 1.0)));
  const double square = speed * speed;
  const double lift = (flow.lift_kg_m[0] + flow.lift_kg_m[1] * alpha) * square;
  const double drag = (flow.drag_kg_m[0] + flow.drag_kg_m[1] * alpha * alpha) * square;
  force.head<3>() = -drag / speed * linear;
  // Across the velocity, upwards: (w, 0, -u) over its length.
  if (in_plane > kLeast_m_s) force.head<3>() += lift / in_plane * Eigen::Vector3d(linear.z(), 0, -linear.x());
  force[1] -= flow.side_kg_m * beta * square;
  force[3] = flow.roll_kg * beta * square;
  force[4] = (flow.pitch_kg[0] + flow.pitch_kg[1] * alpha) * square;
  force[5] = flow.yaw_kg * beta * square;
  return force;
}

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
