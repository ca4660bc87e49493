// SPDX-License-Identifier: Apache-2.0
#include "sim/state.h"

namespace navcal::sim {

State between(const State& a, const State& b, double part) {
  const auto scalar = [&](double from, double to) { return from + part * (to - from); };
  const auto vector = [&](const Vector3& from, const Vector3& to) {
    return Vector3{scalar(from[0], to[0]), scalar(from[1], to[1]), scalar(from[2], to[2])};
  };
  State state = a;
  state.position_m = vector(a.position_m, b.position_m);
  state.euler_rad = vector(a.euler_rad, b.euler_rad);
  state.velocity_body_m_s = vector(a.velocity_body_m_s, b.velocity_body_m_s);
  state.rate_rad_s = vector(a.rate_rad_s, b.rate_rad_s);
  state.specific_force_m_s2 = vector(a.specific_force_m_s2, b.specific_force_m_s2);
  state.rpm = scalar(a.rpm, b.rpm);
  state.fins_rad = vector(a.fins_rad, b.fins_rad);
  state.motor_current_A = scalar(a.motor_current_A, b.motor_current_A);
  state.water_temperature_C = scalar(a.water_temperature_C, b.water_temperature_C);
  return state;
}

}  // namespace navcal::sim
