// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/reference/parameter_deviations.h"
#include "validation/reference/rng.h"
#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {

/// What an effect belongs to, and how it is drawn.
enum class Scope : std::uint8_t { thruster, axis, vehicle, instrument };

/// One effect that a vehicle with thrusters can have.
struct CraftEffectKind {
  std::string_view name;
  Scope scope;
  bool in_library;                           ///< false: a diagnosis must answer unknown
  std::vector<std::string_view> parameters;  ///< with their units; of an instrument those of its EffectKind
  bool is_positive = true;                   ///< of an effect that is no instrument's: its parameters
};

/// Effects of thrusters and vehicle, and those of the instruments that such a vehicle carries (docs/trial.md).
[[nodiscard]] std::span<const CraftEffectKind> craft_effects();
[[nodiscard]] const CraftEffectKind* find_craft_effect(std::string_view name);

struct CraftEffect {
  std::string name;
  std::string of;  ///< "thruster.2", from 1; "heave"; empty
  std::map<std::string, double, std::less<>> parameters;
};

/// All that is different about one vehicle.
struct Differences {
  CraftDeviations craft;
  ParameterDeviations instruments;
};

/// `strength` typical strengths of an effect, of a thruster or axis by the dice. Reversed and dead thrusters have
/// no strength. Typical strengths that depend on the vehicle are taken from the plan.
[[nodiscard]] CraftEffect drawn(const CraftEffectKind& kind, double strength, const Plan& plan, Rng& dice);

/// Adds to what is there. Throws std::invalid_argument for an effect, thruster, axis or parameter that there is
/// not.
void add(const CraftEffect& effect, const Plan& plan, Differences& differences);

/// Errors of identification: each number of the plan times 1 + a normal deviate of `fraction`, mass and places
/// less (docs/trial.md has the table). Shapes stay what they are: symmetric, square, unit vectors.
[[nodiscard]] Plan perturbed(Plan plan, double fraction, Rng& dice);

}  // namespace navcal::reference::thrusters
