// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "base/gravity.h"
#include "sim/layout/assessment/parts.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::assessment {
namespace {

struct Swing {
  std::optional<double> period_s;
  double ratio = 0;
};

Swing swing_about(int axis, double stiffness_Nm, const Matrix6& mass_inverse, const config::LayoutMatrix& linear) {
  const double square = stiffness_Nm * mass_inverse(axis, axis);
  if (!(square > 0)) return {};
  const double omega = std::sqrt(square);
  return {2 * std::numbers::pi / omega,
          linear[7 * static_cast<std::size_t>(axis)] * mass_inverse(axis, axis) / (2 * omega)};
}

}  // namespace

Statics statics_of(const LayoutVehicle& vehicle) {
  const config::Layout& layout = vehicle.layout();
  const LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(layout));
  const Eigen::Vector3d arm_m =
      gravity_centre_m(layout, held.actuators.masses_m) - vector_of(layout.body.buoyancy_centre_m);
  Statics statics;
  statics.mass_kg = layout.body.mass_kg;
  statics.displaced_kg = layout.body.buoyancy_N / base::kGravity_m_s2;
  statics.net_buoyancy_N = 0 - held.restoring.net_weight_N;
  statics.metacentric_height_m = arm_m.z();
  if (arm_m.norm() > 1e-9) {
    statics.roll_rad = std::atan2(arm_m.y(), arm_m.z());
    statics.pitch_rad = 0 - std::atan2(arm_m.x(), std::hypot(arm_m.y(), arm_m.z()));
  }
  const double stiffness_Nm = layout.weight_N() * arm_m.z();
  const Swing roll = swing_about(3, stiffness_Nm, held.mass_inverse, layout.damping.linear);
  const Swing pitch = swing_about(4, stiffness_Nm, held.mass_inverse, layout.damping.linear);
  statics.roll_period_s = roll.period_s;
  statics.pitch_period_s = pitch.period_s;
  statics.roll_damping_ratio = roll.ratio;
  statics.pitch_damping_ratio = pitch.ratio;
  return statics;
}

}  // namespace navcal::sim::assessment
