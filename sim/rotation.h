// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "base/angles.h"
#include "config/settings.h"
#include "sim/state.h"

namespace navcal::sim {

using Matrix3 = std::array<Vector3, 3>;

/// R with v_world = R v_body for Euler angles roll, pitch, yaw (Fossen, zyx convention).
[[nodiscard]] inline Matrix3 R_world_from_body(const Vector3& euler_rad) {
  const auto [phi, theta, psi] = euler_rad;
  const double cf = std::cos(phi), sf = std::sin(phi), ct = std::cos(theta), st = std::sin(theta);
  const double cp = std::cos(psi), sp = std::sin(psi);
  return {{{cp * ct, cp * st * sf - sp * cf, cp * st * cf + sp * sf},
           {sp * ct, sp * st * sf + cp * cf, sp * st * cf - cp * sf},
           {-st, ct * sf, ct * cf}}};
}

/// R with v_body = R v_device for a device that is so mounted.
[[nodiscard]] inline Matrix3 R_body_from_device(const config::MountingSettings& mounting) {
  Vector3 angles_rad{};
  for (std::size_t i = 0; i < 3; ++i) angles_rad[i] = mounting.rotation_deg[i] * base::kRadiansPerDegree;
  return R_world_from_body(angles_rad);
}

[[nodiscard]] inline Vector3 operator*(const Matrix3& m, const Vector3& v) {
  Vector3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

[[nodiscard]] inline Matrix3 transpose(const Matrix3& m) {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}

[[nodiscard]] inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline bool is_turned(const config::MountingSettings& mounting) {
  return mounting.rotation_deg != std::array<double, 3>{};
}

[[nodiscard]] inline bool is_away_from_origin(const config::MountingSettings& mounting) {
  return mounting.position_m != std::array<double, 3>{};
}

/// Body rates of changing Euler angles.
[[nodiscard]] inline Vector3 body_rates(const Vector3& euler_rad, const Vector3& euler_rate_rad_s) {
  const auto [phi, theta, psi] = euler_rad;
  const auto [dphi, dtheta, dpsi] = euler_rate_rad_s;
  return {dphi - dpsi * std::sin(theta), dtheta * std::cos(phi) + dpsi * std::cos(theta) * std::sin(phi),
          -dtheta * std::sin(phi) + dpsi * std::cos(theta) * std::cos(phi)};
}

/// Specific force at the origin, as an accelerometer measures it: dv/dt + omega x v - gravity, all in body
/// axes.
[[nodiscard]] inline Vector3 specific_force(const Vector3& euler_rad, const Vector3& velocity, const Vector3& rate,
                                            const Vector3& velocity_change_m_s2) {
  const Vector3 turning = cross(rate, velocity);
  const double st = std::sin(euler_rad[1]), ct = std::cos(euler_rad[1]);
  const Vector3 gravity{-st * kGravity_m_s2, ct * std::sin(euler_rad[0]) * kGravity_m_s2,
                        ct * std::cos(euler_rad[0]) * kGravity_m_s2};
  Vector3 force{};
  for (std::size_t i = 0; i < 3; ++i) force[i] = velocity_change_m_s2[i] + turning[i] - gravity[i];
  return force;
}

}  // namespace navcal::sim
