// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {

/// The line in which the vehicle's computer reports its outputs: "$PNCAO,v1,...,v8*hh" CR LF, pulse widths in
/// whole microseconds, checksum of NMEA 0183. A channel that the vehicle does not have is empty; more than eight
/// thrusters cannot be reported.
inline constexpr std::size_t kOutputChannels = 8;
[[nodiscard]] std::vector<std::uint8_t> output_line(const std::vector<int>& pulses_us);

/// Pulse of a command. Microseconds are themselves; of other units 1500 us is neutral, 1900 us the upper limit of
/// the command and 1100 us the lower one.
[[nodiscard]] double pulse_of(const PlannedThruster& thruster, double command);
[[nodiscard]] double command_of(const PlannedThruster& thruster, double pulse_us);

}  // namespace navcal::reference::thrusters
