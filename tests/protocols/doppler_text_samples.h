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
  std::array<double, 9> covariance{};
  for (double& one : covariance) one = static_cast<double>(below(random, 1000)) * 1e-9;
  velocity.covariance_m2_s2 = covariance;
  velocity.valid_at_us = static_cast<std::int64_t>(below(random, 1'700'000'000'000'000));
  velocity.transmitted_at_us = *velocity.valid_at_us + 9000;
  return velocity;
}

/// A velocity as the network port sends it, in one of its two styles.
inline std::string water_linked_json(bool with_blanks) {
  std::string line =
      R"({"time":125.1,"vx":0.123,"vy":-0.045,"vz":0.010,"fom":0.0012,"covariance":[[4e-06,0,-1e-7],)"
      R"([0,1.1e-06,0],[0,0,1e-06]],"altitude":3.21,"transducers":[)";
  for (int i = 0; i < 4; ++i)
    line += std::string(i == 0 ? "" : ",") + R"({"id":)" + std::to_string(i) +
            R"(,"velocity":0.01,"distance":3.3,"rssi":-31,"nsd":-90,"beam_valid":true})";
  line += R"(],"velocity_valid":true,"status":0,"format":"json_v3.1","type":"velocity",)"
          R"("time_of_validity":1790000000000000,"time_of_transmission":1790000000120000})";
  std::string out;
  for (const char c : line) out += with_blanks && (c == ':' || c == ',') ? std::string{c, ' '} : std::string{c};
  return out + (with_blanks ? "\n" : "\r\n");
}

template <>
inline Buffer random_frame<pd6::Scanner>(Random& random) {
  if (chance(random)) return pd6::encode(random_pd6_velocity(random));
  return pd6::encode(pd6::Attitude{printed(random, 20, 100), printed(random, 20, 100), 123.45});
}
template <>
inline Buffer random_frame<water_linked::Scanner>(Random& random) {
  switch (below(random, 4)) {
    case 0: return water_linked::encode_line("wra");
    case 1: {
      const std::string line = water_linked_json(chance(random));
      return {line.begin(), line.end()};
    }
    default: return water_linked::encode(random_water_linked_velocity(random));
  }
}

}  // namespace navcal::protocols::test
