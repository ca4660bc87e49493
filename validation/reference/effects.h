// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/rng.h"

namespace navcal::reference {

/// Which signs a kind of departure takes in nature.
enum class Sign : std::uint8_t {
  either,
  positive,      ///< drawn positive; a small negative value is a nominal that was taken too large
  not_negative,  ///< negative makes no sense
};

/// How large a departure is at strength 1, and in which directions it can lie.
struct Size {
  double typical = 0;     ///< of one group, in the unit of the keys
  std::size_t group = 1;  ///< so many parameters in turn are one vector, whose direction is free
  double si = 1;          ///< from the unit of the keys to that of the field
  Sign sign = Sign::either;
  bool symmetric = false;  ///< xx yy zz xy xz yz of a matrix, whose size is its Frobenius norm
};

/// Where a departure may well be the strongest excess: where it enters, and where that leads (a wrong rate turns
/// the predicted attitude, and with it heading, tilt and field). validation/signatures.txt has the
/// channels.
enum class Trace : std::uint8_t {
  field,
  heading,
  tilt,
  roll,  ///< a moment about x
  rates,
  force,
  card,  ///< all that the inertial card measures
  depth,
  fixes,
  drift,
  thrust,
  fins,
  rise,
  supply,  ///< the battery's voltage
  waves,
};

/// One kind of departure by name. The parameters are the keys that a diagnosis answers; each carries its unit.
struct EffectKind {
  std::string_view name;
  Trace trace;
  std::vector<std::string_view> parameters;
  Size size;
  double* (*field)(ParameterDeviations&) = nullptr;  ///< of the first parameter; the others follow it
};

/// A row of the tables below.
[[nodiscard]] inline EffectKind effect_kind(std::string_view name, Trace trace,
                                            std::vector<std::string_view> parameters, const Size& size,
                                            double* (*field)(ParameterDeviations&)) {
  return {name, trace, std::move(parameters), size, field};
}

/// The effects that the diagnosis knows too, in the order of docs/trial.md.
[[nodiscard]] std::span<const EffectKind> library_effects();
/// The effects that no library contains: a diagnosis must answer unknown.
[[nodiscard]] std::span<const EffectKind> foreign_effects();
/// An effect of either kind by name; nullptr if there is none.
[[nodiscard]] const EffectKind* find_effect(std::string_view name);

/// An effect with its strength: values in the units of the keys; what is not named is zero.
struct Effect {
  std::string name;
  std::map<std::string, double, std::less<>> parameters;
};

/// Adds to what is there. Throws std::invalid_argument for an unknown effect or parameter (it lists the known), a
/// number that is not finite, and a negative one that makes no sense.
void add(const Effect& effect, ParameterDeviations& deviations);

/// `strength` typical strengths in a direction by the dice; where only one sign is natural, its magnitude.
[[nodiscard]] Effect drawn(const EffectKind& kind, double strength, Rng& dice);

/// Every vehicle is off by a little everywhere: each parameter of each library effect a normal deviate of
/// `fraction` of its typical strength (its magnitude where negative makes no sense).
void apply_tolerance(double fraction, ParameterDeviations& deviations, Rng& dice);
/// The same for the numbers of the hull, relative; they are nobody's effect.
void apply_tolerance(double fraction, Hull& hull, Rng& dice);

}  // namespace navcal::reference
