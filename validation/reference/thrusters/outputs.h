// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "validation/reference/instrument.h"
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

/// Doppler log of the kind of a Water Linked A50 (ICD section 10, message wrz with the times of a clock that is
/// right): velocity of the origin over ground in body axes, altitude along its own axis; 8 Hz, 100 ms from
/// measurement to the first byte.
///     v (1 + s) + c (T - 15 C) v + noise     s by the speed of sound that it assumes, c its own warming
class Doppler final : public Instrument {
 public:
  struct Errors {
    double scale = 0, scale_per_K = 0;
  };
  Doppler(const Fitting& fitting, const Errors& errors, double floor_m);

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override;

  Errors errors_;
  std::int64_t start_ns_;
  double floor_m_;  ///< depth of the water
  double last_s_ = 0;
};

}  // namespace navcal::reference::thrusters
