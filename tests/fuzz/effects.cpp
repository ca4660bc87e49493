// SPDX-License-Identifier: Apache-2.0
// Any bytes as a file of effects: problems, or effects whose parameters are numbers within their ranges.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sim/effects/choice.h"
#include "sim/effects/document.h"
#include "sim/layout/effects/layout_effects.h"
#include "sim/layout/layout_of.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::effects_target {

NAVCAL_FUZZ(effects) {
  using namespace navcal::sim;
  EffectSet set;
  std::vector<navcal::config::Problem> problems;
  add_effects({reinterpret_cast<const char*>(data), size}, set, problems);
  if (!problems.empty() && set.size() > 0) std::abort();
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto parameters = set[i].description().parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (refusal(parameters[k], set[i].parameters()[k])) std::abort();
    }
    if (!(set.interval(i).from_s < set.interval(i).until_s)) std::abort();
  }
  const navcal::config::Layout layout = layout_of({});
  EffectSet on_layout;
  problems.clear();
  add_effects({reinterpret_cast<const char*>(data), size}, on_layout, problems, &layout);
  if (!problems.empty() && !on_layout.layout_members().empty()) std::abort();
  for (const EffectSet::LayoutMember& member : on_layout.layout_members()) {
    const LayoutEffect& effect = member.effect;
    if (owner_refusal(layout, *effect.about, effect.of)) std::abort();
    if (effect.values.size() != effect.about->parameters.size()) std::abort();
    (void)changed_layout(layout, effect);
  }
  return 0;
}

}  // namespace navcal::fuzz::effects_target
