// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::gap {

struct Mission;

/// Quantities that a recording may lack, as a whole or for a while.
enum class Quantity : std::uint8_t {
  heading,  ///< magnetic, as the compass states it or by its field
  field,
  tilt,  ///< roll and pitch of the inclinometer
  rates,
  second_yaw_rate,
  force,
  depth,
  fixes,
  motor,  ///< reports of the motor card
};
inline constexpr std::size_t kQuantities = 9;

/// A silence shorter than this is a gap of the line: the replay goes over it, and nothing is said.
inline constexpr double kSilent_s = 30;

/// A time in which a quantity was not reported. Silence of the fixes is stated only where there is hardly one in
/// the whole recording: a vehicle under water has none.
struct Silence {
  Quantity quantity = Quantity::heading;
  double from_s = 0, until_s = 0;

  /// Whether a time is in it. The end of a recording of this length ends no silence.
  [[nodiscard]] bool contains(double time_s, double duration_s) const {
    return time_s >= from_s && (time_s < until_s || until_s >= duration_s);
  }
  bool operator==(const Silence&) const = default;
};

/// Silences of one quantity, from the ascending times of its readings, in a recording from 0 to `duration_s`.
/// A quantity with readings is silent in no time that is shorter than kSilent_s.
[[nodiscard]] std::vector<Silence> silences_of(Quantity quantity, std::span<const double> times_s,
                                               double duration_s);

/// Finds the silences of a mission, and the time for which it can be judged: the longest one in which the motor
/// card reports. While the inertial card is silent, readings without values take the place of its frames, because
/// they carry the replay. A mission with all instruments is not changed.
void find_silences(Mission& mission);

/// Quantities that an instrument gives, by the names of `navcal gap --without`: compass, field, tilt, card, gyros,
/// accelerometers, depth, gps, motor. Throws std::invalid_argument, which lists them.
[[nodiscard]] std::vector<Quantity> quantities_named(std::string_view name);
[[nodiscard]] std::vector<Quantity> quantities_of(std::span<const std::string> names);

/// Makes a mission one that lacks these quantities, then as find_silences(). A field of the Earth that follows
/// from the fixes is fitted to the compass instead.
void leave_out(std::span<const Quantity> quantities, Mission& mission);

/// Takes from a simulated mission what the recorded one lacks.
void silence_like(const Mission& recorded, Mission& simulated);

/// "no GPS", "no magnetic field", "no inertial card": what is silent all the time.
[[nodiscard]] std::vector<std::string> missing_instruments(const Mission& mission);

/// An instrument that is silent for part of the mission.
struct Interruption {
  std::string what;  ///< "compass", "depth gauge"
  double from_s = 0, until_s = 0;
};
[[nodiscard]] std::vector<Interruption> interruptions(const Mission& mission);

/// Silences as a text that is equal for missions whose nulls may be shared: times in windows of ten seconds.
/// Empty: nothing is silent.
[[nodiscard]] std::string silence_key(const Mission& mission);

}  // namespace navcal::gap
