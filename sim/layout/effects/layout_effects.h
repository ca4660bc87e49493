// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/layout.h"
#include "sim/effects/description.h"

// Departures of a vehicle from its layout. Each is a pure function from a layout and a size to a changed layout,
// so that the simulator and a diagnosis use the same code, and a file can be written of the result.
namespace navcal::sim {

/// What an effect belongs to.
enum class LayoutPart : std::uint8_t {
  vehicle,
  thruster,
  surface,
  ballast,
  moving_mass,
  actuator,  ///< any of the four before
  freedom,   ///< a degree of freedom: "surge"
};

/// What the typical size of a parameter counts in.
enum class LayoutScale : std::uint8_t {
  one,
  mass_kg,
  weight_N,
  length_m,  ///< cube root of the volume of water that it displaces, or that weighs as much where that is more
};

/// The part that an effect changes: the vehicle, an actuator by kind and number from 0, or a degree of freedom, 0
/// surge to 5 yaw.
struct LayoutOwner {
  LayoutPart part = LayoutPart::vehicle;
  std::size_t index = 0;
};

struct LayoutEffectDescription {
  std::string_view name;
  std::string_view equation;
  /// Zero is neutral; `typical` times the scale is strength 1.
  std::span<const EffectParameter> parameters;
  LayoutPart part = LayoutPart::vehicle;
  LayoutScale scale = LayoutScale::one;
  TellingManoeuvre manoeuvre;
  /// The effect of these values, one for each parameter, on one owner.
  void (*change)(config::Layout& layout, const LayoutOwner& owner, std::span<const double> values);
  /// Number of consecutive parameters that are the components of one vector.
  std::size_t vector = 1;
  /// The layout's number that a dead band adds to, in the unit of the parameter: what it can lose.
  double (*number)(const config::Layout& layout, const LayoutOwner& owner) = nullptr;
};

/// An effect with its size.
struct LayoutEffect {
  const LayoutEffectDescription* about = nullptr;
  /// "thruster.2", or the actuator's own name; "surge". Empty: the vehicle, or all parts of the kind.
  std::string of;
  std::vector<double> values;  ///< one for each parameter
};

/// All effects, by name.
[[nodiscard]] std::span<const LayoutEffectDescription> layout_effects();
/// nullptr when none has this name.
[[nodiscard]] const LayoutEffectDescription* find_layout_effect(std::string_view name);

/// What an effect can belong to in this layout: "thruster.1", "thruster.2"; empty for the whole vehicle, or when
/// the layout has no such part.
[[nodiscard]] std::vector<std::string> owners_of(const config::Layout& layout,
                                                 const LayoutEffectDescription& about);

/// Why an effect cannot belong to `of`, with what it can belong to; nullopt: it can.
[[nodiscard]] std::optional<std::string> owner_refusal(const config::Layout& layout,
                                                       const LayoutEffectDescription& about, std::string_view of);

/// The parameters with their typical sizes and bounds in this layout, in the units of their names.
[[nodiscard]] std::vector<EffectParameter> parameters_for(const config::Layout& layout,
                                                          const LayoutEffectDescription& about);

/// The layout with this effect. An effect whose owner it does not have changes nothing.
[[nodiscard]] config::Layout changed_layout(config::Layout layout, const LayoutEffect& effect);

/// The table of these effects as people read it, in the form that docs/simulator.md takes.
[[nodiscard]] std::string layout_effects_text();

}  // namespace navcal::sim
