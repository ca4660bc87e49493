// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/missions.h"
#include "validation/reference/thrusters/swim.h"

namespace navcal::validation {

/// Kinds of cases in a validation on layouts.
enum class LayoutArm : std::uint8_t {
  nulls,        ///< no effect
  single_half,  ///< one effect at half its typical strength, and so on
  single,
  single_double,
  pairs,    ///< two effects
  removed,  ///< one effect that the library is to be without
  foreign,  ///< one effect that no library holds
};
inline constexpr int kLayoutArms = 7;
[[nodiscard]] std::string_view name_of(LayoutArm arm);
/// "nulls" and so on; throws std::invalid_argument, which lists them.
[[nodiscard]] LayoutArm layout_arm_named(std::string_view name);

/// A shipped layout, or one of the user's: `name` for people, and the file's text.
struct NamedLayout {
  std::string name, text;
};

/// One vehicle: its layout is off by the errors of an identification that is yet to come.
struct LayoutVehicleCase {
  int number = 1;  ///< from 1
  NamedLayout layout;
  reference::thrusters::CraftUnderTest craft;
  TrialPlace place;
};

struct LayoutErrors {
  double layout = 0.05;   ///< reference::thrusters::perturbed
  double unmodelled = 1;  ///< factor on the spreads of reference::thrusters::Nature
};

/// The same seed, number, layouts and errors give the same vehicle on every machine. Layouts are taken by turns.
/// `errors`: how far it is off what its layout states, and off what any layout can state. Throws
/// std::invalid_argument for a layout that cannot be read or has other actuators than thrusters, or more than
/// eight of them.
[[nodiscard]] LayoutVehicleCase drawn_vehicle(std::uint64_t seed, int number, std::span<const NamedLayout> layouts,
                                              const LayoutErrors& errors);

/// Truth of one case, which a diagnosis must not know before it has answered.
struct LayoutCase {
  int number = 1;
  int vehicle = 1;
  LayoutArm arm = LayoutArm::nulls;
  std::vector<reference::thrusters::CraftEffect> effects;
  std::string excluded;                        ///< effect that the library is to be without
  reference::thrusters::CraftUnderTest craft;  ///< the vehicle on this day, with the effects
};

/// How much a vehicle changes from one day to the next: reference::thrusters::perturbed.
inline constexpr double kDayTolerance = 0.005;

/// The vehicle without an effect, on a day of its own.
[[nodiscard]] reference::thrusters::CraftUnderTest nominal_day(std::uint64_t seed,
                                                               const LayoutVehicleCase& vehicle, int day);
/// The arm follows from the number; effects come by turns, so that each comes once before any comes again.
/// `attempt`: another draw of the same case, for effects with which the vehicle cannot swim; after six of them the
/// next effect is drawn.
[[nodiscard]] LayoutCase drawn_layout_case(std::uint64_t seed, int number, const LayoutVehicleCase& vehicle,
                                           int attempt);

/// A mission of this vehicle by the dice of a seed. `day` counts from that of the place.
[[nodiscard]] reference::thrusters::Swim drawn_swim(const LayoutVehicleCase& vehicle, std::uint64_t mission_seed,
                                                    double duration_s, int day);

/// Lines of JSON with what is true, and what the numbers of the vehicle really are.
[[nodiscard]] std::string truth_text(const LayoutVehicleCase& vehicle, std::uint64_t seed,
                                     const LayoutErrors& errors);
[[nodiscard]] std::string truth_text(const LayoutCase& drawn, std::uint64_t seed);
/// Name of an effect with what it belongs to: "thrust_scale of thruster.2".
[[nodiscard]] std::string full_name(const reference::thrusters::CraftEffect& effect);

}  // namespace navcal::validation
