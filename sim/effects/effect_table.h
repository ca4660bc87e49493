// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sim/effects/effect.h"

namespace navcal::sim {

/// The files of sim/effects/library, each of which defines make_NAME(): the table is written by CMake.
struct EffectEntry {
  std::string_view name;
  std::unique_ptr<Effect> (*make)();
};
/// By name, in order of the alphabet.
[[nodiscard]] std::span<const EffectEntry> effect_table();

/// Neutral. nullptr when there is none of this name.
[[nodiscard]] std::unique_ptr<Effect> make_effect(std::string_view name);

}  // namespace navcal::sim
