// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/pd6.h"
#include "protocols/water_linked.h"
#include "tests/protocols/ubx_samples.h"

// Random lines of Doppler logs.
namespace navcal::protocols::test {

inline pd6::Velocity random_pd6_velocity(Random& random) {
  constexpr FrameId kAny[] = {pd6::kBottomInstrument, pd6::kBottomEarth, pd6::kWaterShip};
  pd6::Velocity velocity{kAny[below(random, 3)], {}, {}, chance(random)};
  for (auto& one : velocity.velocity_m_s) one = perhaps(random, on_step(random, -32767, 32767, 1e-3));
  if (velocity.line == pd6::kBottomInstrument) velocity.error_velocity_m_s = on_step(random, -999, 999, 1e-3);
  return velocity;
}

/// A number as the line prints it.
inline double in_decimals(Random& random, int limit, double per_unit) { return printed(random, limit, per_unit); }

inline water_linked::Velocity random_water_linked_velocity(Random& random) {
  water_linked::Velocity velocity;
  for (double& one : velocity.velocity_m_s) one = in_decimals(random, 5, 1000);
  velocity.valid = chance(random);
  velocity.altitude_m = in_decimals(random, 50, 100);
  velocity.figure_of_merit_m_s = in_decimals(random, 2, 1000);
  velocity.since_last_ms = in_decimals(random, 500, 100);
  velocity.status = static_cast<std::uint32_t>(below(random, 2));
  if (chance(random)) {
    std::array<double, 9> covariance{};
    for (double& one : covariance) one = static_cast<double>(below(random, 1000)) * 1e-9;
    velocity.covariance_m2_s2 = covariance;
    velocity.valid_at_us = static_cast<std::int64_t>(below(random, 1'700'000'000'000'000));
    velocity.transmitted_at_us = *velocity.valid_at_us + 9000;
  }
  return velocity;
}

template <>
inline Buffer random_frame<pd6::Scanner>(Random& random) {
  if (chance(random)) return pd6::encode(random_pd6_velocity(random));
  return pd6::encode(pd6::Attitude{printed(random, 20, 100), printed(random, 20, 100), 123.45});
}
template <>
inline Buffer random_frame<water_linked::Scanner>(Random& random) {
  if (chance(random)) return water_linked::encode(random_water_linked_velocity(random));
  return water_linked::encode_line("wra");
}

}  // namespace navcal::protocols::test
