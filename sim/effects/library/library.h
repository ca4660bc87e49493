// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/effects/effect_table.h"

namespace navcal::sim {

template <class E>
std::unique_ptr<Effect> new_effect() {
  return std::make_unique<E>();
}

/// Entries of the effects that one file of the library defines.
template <class... E>
std::span<const EffectEntry> entries_of() {
  static constexpr std::array kEntries{EffectEntry{E::kName, &new_effect<E>}...};
  return kEntries;
}

// The files of the library; effect_table.cpp joins them.
std::span<const EffectEntry> effects_of_card();
std::span<const EffectEntry> effects_of_compass();
std::span<const EffectEntry> effects_of_fins();
std::span<const EffectEntry> effects_of_gyros();
std::span<const EffectEntry> effects_of_lines();
std::span<const EffectEntry> effects_of_receiver();
std::span<const EffectEntry> effects_of_vehicle();

}  // namespace navcal::sim
