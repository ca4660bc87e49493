// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/layout.h"

namespace navcal::sim {

/// One number for each actuator of a layout, in its order: commands, or where the actuators are.
struct ActuatorValues {
  std::vector<double> thrusters;  ///< in the unit of each command
  std::vector<double> surfaces_rad;
  std::vector<double> ballasts_N;  ///< added buoyancy
  std::vector<double> masses_m;    ///< along the axis

  /// All neutral: thrusters off, angles, ballasts and places zero, or the nearest that limits allow.
  [[nodiscard]] static ActuatorValues neutral(const config::Layout& layout);
};

/// Positions of the actuators after a step towards constant commands. Thrusters and surfaces follow with
/// first-order lags, exactly over the step: p' = (c - p)/T, p(t + h) = p + (1 - exp(-h/T)) (c - p), with c within
/// its limits and neutral in its dead band, behind what the actuator makes of its command (config::LayoutHeard).
/// Ballasts and moving masses go at their rates.
[[nodiscard]] ActuatorValues follow(const config::Layout& layout, const ActuatorValues& positions,
                                    const ActuatorValues& commands, double step_s);

/// The means of two, which the model holds over a step.
[[nodiscard]] ActuatorValues mean_of(const ActuatorValues& a, const ActuatorValues& b);

}  // namespace navcal::sim
