// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/snapshot.h"

#include <cmath>

namespace navcal::reference {

double Snapshot::heading_rad() const {
  const Vector3 forward = world_from_body * Vector3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

double Snapshot::pitch_rad() const {
  const Vector3 d = down();
  return std::atan2(-d.x(), std::hypot(d.y(), d.z()));
}

double Snapshot::roll_rad() const {
  const Vector3 d = down();
  return std::atan2(d.y(), d.z());
}

Eigen::Quaterniond attitude(double roll_rad, double pitch_rad, double heading_rad) {
  return Eigen::AngleAxisd(heading_rad, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vector3::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Vector3::UnitX());
}

Snapshot between(const Snapshot& first, const Snapshot& second, double part) {
  const auto mix = [part](const auto& a, const auto& b) { return (a + part * (b - a)).eval(); };
  Snapshot s;
  s.time_s = first.time_s + part * (second.time_s - first.time_s);
  s.position_m = mix(first.position_m, second.position_m);
  s.world_from_body.coeffs() = mix(first.world_from_body.coeffs(), second.world_from_body.coeffs());
  s.world_from_body.normalize();
  s.velocity_m_s = mix(first.velocity_m_s, second.velocity_m_s);
  s.rate_rad_s = mix(first.rate_rad_s, second.rate_rad_s);
  s.acceleration_m_s2 = mix(first.acceleration_m_s2, second.acceleration_m_s2);
  s.current_m_s = mix(first.current_m_s, second.current_m_s);
  s.servos_rad = mix(first.servos_rad, second.servos_rad);
  s.shaft_rev_s = std::lerp(first.shaft_rev_s, second.shaft_rev_s, part);
  s.motor_current_A = std::lerp(first.motor_current_A, second.motor_current_A, part);
  s.supply_loss = std::lerp(first.supply_loss, second.supply_loss, part);
  s.electronics_C = std::lerp(first.electronics_C, second.electronics_C, part);
  s.gravity_m_s2 = first.gravity_m_s2;
  return s;
}

}  // namespace navcal::reference
