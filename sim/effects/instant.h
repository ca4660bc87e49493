// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/rotation.h"
#include "sim/state.h"

namespace navcal::sim {

/// Input of an effect at one instant. It contains nothing measured, so the diagnosis can differentiate an
/// effect at predicted, noise-free values.
struct Instant {
  double time_s = 0;  ///< since the beginning of the mission
  const State& state;
  double electronics_C = base::reference::kTemperature_C;  ///< temperature of the electronics

  /// Temperature of the electronics above the reference of the temperature coefficients.
  [[nodiscard]] double temperature_rise_C() const { return electronics_C - base::reference::kTemperature_C; }
  /// Acceleration of the body's origin relative to the world, in body axes: the specific force plus gravity.
  [[nodiscard]] Vector3 acceleration_m_s2() const {
    const Vector3 gravity = transpose(R_world_from_body(state.euler_rad)) * Vector3{0, 0, kGravity_m_s2};
    Vector3 result = state.specific_force_m_s2;
    for (std::size_t i = 0; i < 3; ++i) result[i] += gravity[i];
    return result;
  }
};

}  // namespace navcal::sim
