// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect_table.h"

#include <algorithm>

namespace navcal::sim {

std::unique_ptr<Effect> make_effect(std::string_view name) {
  const auto table = effect_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const EffectEntry& entry) { return entry.name == name; });
  return found == table.end() ? nullptr : found->make();
}

}  // namespace navcal::sim
