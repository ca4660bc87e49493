// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/effects/effect_table.h"

namespace navcal::sim {

/// Parameters of these names, with blanks between them, that are alike in their numbers.
constexpr ShortList<EffectParameter, 12> alike(std::string_view names, double typical, double least,
                                               double greatest) {
  std::array<EffectParameter, 12> parameters;
  std::size_t count = 0;
  for (; !names.empty(); ++count) {
    const std::string_view name = names.substr(0, names.find(' '));
    names.remove_prefix(std::min(names.size(), name.size() + 1));
    parameters.at(count) = {name, typical, least, greatest};
  }
  return std::span<const EffectParameter>(parameters).first(count);
}

/// Entries of the effects that one file of the library defines.
template <class... E>
std::span<const EffectEntry> entries_of() {
  static constexpr std::array kEntries{
      EffectEntry{E::kName, []() -> std::unique_ptr<Effect> { return std::make_unique<E>(); }}...};
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
