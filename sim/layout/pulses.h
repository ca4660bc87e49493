// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/layout/actuators.h"

namespace navcal::sim {

/// Meaning of the pulses that a servo or speed controller takes, in us. A thruster that is commanded in us has its
/// command; of any other actuator 1500 us are neutral, 1900 the upper limit of the command and 1100 the lower one,
/// with straight lines between them. A limit at neutral leaves nothing on its side.
struct PulseRange {
  double low, neutral, high;  ///< commands
  bool is_pulse = false;      ///< a command is a pulse

  /// Not bounded by the limits.
  [[nodiscard]] double command(double pulse_us) const;
};
/// The ranges of all actuators: thrusters, surfaces, ballasts, moving masses, each in the order of the layout.
[[nodiscard]] std::vector<PulseRange> pulse_ranges(const config::Layout& layout);

/// Commands of all actuators as pulses, in the order of their ranges. Whole us, as they are sent.
[[nodiscard]] std::vector<double> pulses_of(const config::Layout& layout, const ActuatorValues& commands);

/// The commands that these pulses mean, within their limits; pulses that are missing count as neutral.
[[nodiscard]] ActuatorValues commands_of(const config::Layout& layout, const std::vector<double>& pulses_us);

/// Number of actuators.
[[nodiscard]] std::size_t outputs_of(const config::Layout& layout);

}  // namespace navcal::sim
