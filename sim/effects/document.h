// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "config/document.h"
#include "sim/effects/effect_set.h"

namespace navcal::sim {

/// Adds the effects of a TOML text, a table each, to a set:
///   [motor_field]
///   x_uT_per_A = 0.8
///   from_s = 120
/// Parameters that are not named are zero; `from_s` and `until_s` switch the effect on and off during the mission.
/// What is wrong is noted, and then nothing is added. With a layout, the effects of sim/layout/effects act on the
/// vehicle; `of` says what they belong to, and an array [[thrust_scale]] has one for each of several.
void add_effects(std::string_view toml, EffectSet& set, std::vector<config::Problem>& problems,
                 const config::Layout* layout = nullptr);

}  // namespace navcal::sim
