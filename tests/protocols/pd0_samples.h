// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/pd0.h"
#include "tests/protocols/ubx_samples.h"

// Random ensembles of a Doppler log.
namespace navcal::protocols::test {

inline pd0::Ensemble random_ensemble(Random& random) {
  pd0::Ensemble ensemble;
  ensemble.fixed = pd0::FixedLeader{51,
                                    41,
                                    static_cast<std::uint16_t>(random()),
                                    4,
                                    30,
                                    static_cast<pd0::Axes>(below(random, 4)),
                                    chance(random),
                                    chance(random),
                                    chance(random),
                                    on_step(random, -18000, 18000, 0.01),
                                    on_step(random, -18000, 18000, 0.01),
                                    static_cast<std::uint8_t>(random()),
                                    static_cast<std::uint8_t>(random()),
                                    static_cast<std::uint8_t>(below(random, 90))};
  pd0::VariableLeader variable;
  variable.ensemble = static_cast<std::uint32_t>(below(random, 1U << 24));
  variable.date = {static_cast<std::uint16_t>(2000 + below(random, 50)), 7, 31};
  variable.time = {13, 14, static_cast<std::uint8_t>(below(random, 60)),
                   static_cast<std::uint32_t>(below(random, 100)) * 10'000'000U};
  variable.speed_of_sound_m_s = 1400 + static_cast<double>(below(random, 200));
  variable.depth_m = on_step(random, 0, 9999, 0.1);
  variable.heading_deg = on_step(random, 0, 35999, 0.01);
  variable.pitch_deg = on_step(random, -2000, 2000, 0.01);
  variable.roll_deg = on_step(random, -2000, 2000, 0.01);
  variable.salinity_ppt = static_cast<double>(below(random, 41));
  variable.temperature_C = on_step(random, -500, 4000, 0.01);
  if (chance(random)) variable.pressure_Pa = on_step(random, 0, 1'000'000, 10);
  ensemble.variable = variable;
  if (chance(random)) {
    pd0::BottomTrack bottom;
    for (std::size_t i = 0; i < 4; ++i) {
      if (chance(random)) bottom.range_m[i] = on_step(random, 1, 200'000, 0.01);
      if (chance(random)) bottom.velocity_m_s[i] = on_step(random, -32767, 32767, 1e-3);
      if (chance(random)) bottom.water_velocity_m_s[i] = on_step(random, -32767, 32767, 1e-3);
      bottom.percent_good[i] = static_cast<std::uint8_t>(below(random, 101));
      bottom.water_percent_good[i] = static_cast<std::uint8_t>(below(random, 101));
    }
    ensemble.bottom = bottom;
  }
  return ensemble;
}

template <>
inline Buffer random_frame<pd0::Scanner>(Random& random) {
  if (below(random, 4) > 0) return pd0::encode(random_ensemble(random));
  return pd0::encode_types({Buffer(2 + below(random, 300), 0x7F), Buffer(20, 0x7F)});
}

}  // namespace navcal::protocols::test
