// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "instruments/samples.h"

namespace navcal::instruments {

/// Takes out of a Doppler log's sample what cannot be. False when something could not be: velocities above 20 m/s,
/// altitudes that are negative or above 11 km, water below -5 or above 50 degrees, sound slower than 1300 or
/// faster than 1700 m/s.
[[nodiscard]] inline bool clear_of_impossible(DvlSample& sample) {
  bool can_be = true;
  const auto keep_between = [&](std::optional<double>& value, double least, double most) {
    if (!value || (*value >= least && *value <= most)) return;
    value.reset();
    can_be = false;
  };
  const auto keep_slow = [&](std::optional<Vector3>& velocity_m_s, std::optional<double>& std_m_s) {
    constexpr double kMaxSpeed_m_s = 20;
    if (!velocity_m_s || std::all_of(velocity_m_s->begin(), velocity_m_s->end(),
                                     [](double one) { return std::abs(one) <= kMaxSpeed_m_s; })) {
      return;
    }
    velocity_m_s.reset();
    std_m_s.reset();
    can_be = false;
  };
  keep_slow(sample.bottom_velocity_m_s, sample.bottom_velocity_std_m_s);
  keep_slow(sample.water_velocity_m_s, sample.water_velocity_std_m_s);
  keep_between(sample.altitude_m, 0, 11'000);
  keep_between(sample.temperature_C, -5, 50);
  keep_between(sample.sound_speed_m_s, 1300, 1700);
  return can_be;
}

}  // namespace navcal::instruments
