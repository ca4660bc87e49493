// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "sim/state.h"

namespace navcal::sim {

/// Model: T' = (T_water + 8 C - T)/200 s, begun at the water's temperature when power comes (docs/simulator.md).
/// The water's is taken to go straight from one full second after power-on to the next, so that every instrument
/// powered at the same time says the same, whenever it is asked.
class Electronics {
 public:
  static constexpr double kAboveWater_C = 8;
  static constexpr double kSettles_s = 200;

  void power_on(std::int64_t t_ns, const Motion& motion) {
    begin_ns_ = t_ns;
    water_C_ = next_water_C_ = water(motion);
    temperature_C_ = water_C_;
    advance(motion);
  }
  /// Times may go back by less than the second.
  [[nodiscard]] double temperature_C(std::int64_t t_ns, const Motion& motion) {
    while (t_ns - begin_ns_ >= kSecond_ns) {
      temperature_C_ = after(1);
      begin_ns_ += kSecond_ns;
      water_C_ = next_water_C_;
      advance(motion);
    }
    return t_ns > begin_ns_ ? after(static_cast<double>(t_ns - begin_ns_) * 1e-9) : temperature_C_;
  }

 private:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;

  [[nodiscard]] double water(const Motion& motion) const { return motion.at(begin_ns_).water_temperature_C; }
  void advance(const Motion& motion) { next_water_C_ = motion.at(begin_ns_ + kSecond_ns).water_temperature_C; }
  /// Exact for water whose temperature changes by `slope` a second: T lags behind by slope times 200 s.
  [[nodiscard]] double after(double seconds) const {
    const double slope = next_water_C_ - water_C_;
    const double settled = water_C_ + kAboveWater_C - slope * kSettles_s;
    return settled + slope * seconds + (temperature_C_ - settled) * std::exp(-seconds / kSettles_s);
  }

  std::int64_t begin_ns_ = 0;
  double water_C_ = base::reference::kTemperature_C, next_water_C_ = water_C_, temperature_C_ = water_C_;
};

}  // namespace navcal::sim
