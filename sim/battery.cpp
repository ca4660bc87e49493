// SPDX-License-Identifier: Apache-2.0
#include "sim/battery.h"

#include <algorithm>
#include <cmath>

namespace navcal::sim {

Battery::Battery(const Options& options)
    : options_(options), charge_Ah_(std::clamp(options.charge_Ah, 0.0, options.capacity_Ah)) {}

void Battery::draw(double motor_A, double duration_s) {
  constexpr double kSecondsPerHour = 3600;
  charge_Ah_ =
      std::clamp(charge_Ah_ - current_A(motor_A) * duration_s / kSecondsPerHour, 0.0, options_.capacity_Ah);
}

double Battery::open_circuit_V() const {
  const double place = charge_Ah_ / options_.capacity_Ah * static_cast<double>(options_.curve_V.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), options_.curve_V.size() - 2);
  return std::lerp(options_.curve_V[below], options_.curve_V[below + 1], place - static_cast<double>(below));
}

double Battery::voltage_V(double motor_A) const {
  return open_circuit_V() - options_.resistance_ohm * current_A(motor_A);
}

}  // namespace navcal::sim
