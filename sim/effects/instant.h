// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/rotation.h"
#include "sim/state.h"

namespace navcal::sim {

/// What an effect may know of one instant: nothing that was measured, so that who differentiates an effect may
/// give it what he predicts, free of noise.
struct Instant {
  double time_s = 0;  ///< since the beginning of the mission
  const State& state;
  double electronics_C = base::reference::kTemperature_C;  ///< temperature of the electronics

  /// Above that to which the temperature coefficients refer.
  [[nodiscard]] double temperature_rise_C() const { return electronics_C - base::reference::kTemperature_C; }
  /// Of the origin against the world, in body axes: what is felt, with gravity put back.
  [[nodiscard]] Vector3 acceleration_m_s2() const {
    const Vector3 gravity = transpose(R_world_from_body(state.euler_rad)) * Vector3{0, 0, kGravity_m_s2};
    Vector3 result = state.specific_force_m_s2;
    for (std::size_t i = 0; i < 3; ++i) result[i] += gravity[i];
    return result;
  }
};

}  // namespace navcal::sim
