// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"

namespace navcal::reference {

/// Through still water: body axes at the centre of buoyancy, SI.
struct Flow {
  Vector3 velocity_m_s = Vector3::Zero();
  Vector3 rate_rad_s = Vector3::Zero();
};

/// Force and moment about the origin, body axes: (X, Y, Z, K, M, N).
using Wrench = Vector6;

/// Force and moment of the water on the hull: axial drag, cross-flow drag (strip theory: each station by its own
/// velocity across; Fossen, Handbook, ch. 6), lift of the body. The factors are 1 nominally.
[[nodiscard]] Wrench hull_wrench(const Hull& hull, const Flow& flow, double axial_factor, double crossflow_factor);

/// Force and moment of the three fins, 120 degrees apart, each a plate in its own stream with lift linear in the
/// angle of attack up to 0.45 rad and induced drag; beyond `kStall_rad` the share `stall_loss` of the angle is
/// lost.
[[nodiscard]] Wrench fin_wrench(const Hull& hull, const Flow& flow, const Vector3& fins_rad, double stall_loss);
inline constexpr double kStall_rad = 8 * 0.017453292519943295;

/// Open-water propeller, thrust linear in the advance ratio, nothing at rest or astern. `thrust_factor` leaves its
/// torque alone.
[[nodiscard]] Wrench propeller_wrench(const Hull& hull, double surge_m_s, double shaft_rev_s, double thrust_factor,
                                      double torque_leak);

/// Weight and buoyancy, equal nominally: `down` is the unit vector downwards in body axes.
[[nodiscard]] Wrench static_wrench(const Hull& hull, const Vector3& down, double lift_N);

/// Linear damping of roll, pitch and yaw, by ratios of the hull's own oscillations.
[[nodiscard]] Wrench damping_wrench(const Hull& hull, const Matrix6& inertia, const Vector3& rate_rad_s,
                                    double further_yaw_per_s);

}  // namespace navcal::reference
