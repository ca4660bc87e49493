// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect_table.h"

#include <algorithm>
#include <vector>

#include "sim/effects/library/library.h"

namespace navcal::sim {

std::span<const EffectEntry> effect_table() {
  static const std::vector<EffectEntry> kTable = [] {
    std::vector<EffectEntry> table;
    for (const auto effects : {effects_of_card(), effects_of_compass(), effects_of_fins(), effects_of_gyros(),
                               effects_of_lines(), effects_of_receiver(), effects_of_vehicle()})
      table.insert(table.end(), effects.begin(), effects.end());
    std::ranges::sort(table, {}, &EffectEntry::name);
    return table;
  }();
  return kTable;
}

std::unique_ptr<Effect> make_effect(std::string_view name) {
  const auto table = effect_table();
  const auto found = std::ranges::find(table, name, &EffectEntry::name);
  return found == table.end() ? nullptr : found->make();
}

}  // namespace navcal::sim
