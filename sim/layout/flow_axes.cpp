// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/flow_axes.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {

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

}  // namespace navcal::sim
