// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sim/effects/effect.h"

namespace navcal::sim {

/// An effect of sim/effects/library.
struct EffectEntry {
  std::string_view name;
  std::unique_ptr<Effect> (*make)();
};
/// All effects by name, in alphabetical order.
[[nodiscard]] std::span<const EffectEntry> effect_table();

/// A new effect with neutral parameters; nullptr when no effect has this name.
[[nodiscard]] std::unique_ptr<Effect> make_effect(std::string_view name);

}  // namespace navcal::sim
