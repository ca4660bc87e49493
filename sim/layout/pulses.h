// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/layout/actuators.h"

namespace navcal::sim {

/// Commands of all actuators as pulses in us, as servos and speed controllers take them: thrusters, surfaces,
/// ballasts, moving masses, each in the order of the layout. A thruster that is commanded in us has its command;
/// of any other 1500 us are neutral, 1900 the upper limit of the command and 1100 the lower one, with straight
/// lines between them. A limit at neutral leaves nothing on its side. Whole us, as they are sent.
[[nodiscard]] std::vector<double> pulses_of(const config::Layout& layout, const ActuatorValues& commands);

/// The commands that these pulses mean; pulses that are missing count as neutral.
[[nodiscard]] ActuatorValues commands_of(const config::Layout& layout, const std::vector<double>& pulses_us);

/// Number of actuators.
[[nodiscard]] std::size_t outputs_of(const config::Layout& layout);

}  // namespace navcal::sim
