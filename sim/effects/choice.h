// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/effects/effect.h"
#include "sim/noise.h"

namespace navcal::sim {

/// Draws parameters of `strength` typical values, in a random direction (or sign). A parameter that allows one
/// sign only gets that sign.
[[nodiscard]] std::vector<double> drawn_parameters(const EffectDescription& effect, double strength, Noise& noise);

/// Why a value cannot be ("tau_s lies between 0 and 10"), or nothing.
[[nodiscard]] std::optional<std::string> refusal(const EffectParameter& parameter, double value);

/// Why an effect by name cannot act on a layout, or nothing: of the effects on the vehicle itself only the water's
/// current does, the others have a counterpart in sim/layout/effects; a layout states no motor current.
[[nodiscard]] std::optional<std::string> refusal_for_layout(const EffectDescription& effect);

/// "there is no effect magnetfield; did you mean ...? Known are: ...".
/// With a layout the effects on it are known too.
[[nodiscard]] std::string unknown_effect(std::string_view name, bool of_layout = false);

/// Throws std::invalid_argument for a name of --exclude that is no effect.
void expect_effects(std::span<const std::string> excluded);

/// The table of all effects as people read it, in the form that docs/simulator.md takes.
[[nodiscard]] std::string effects_text();

}  // namespace navcal::sim
