// SPDX-License-Identifier: Apache-2.0
// What the description of every effect must say, for people and for the diagnosis.
#include "sim/effects/description.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "sim/effects/effect_table.h"

namespace navcal::sim::testing {
namespace {

// An effect whose file names no manoeuvre does not compile: the field has no default.
static_assert(!std::is_default_constructible_v<TellingManoeuvre>);
static_assert(!std::is_default_constructible_v<EffectDescription>);

bool is_cause(const EffectDescription& effect) { return effect.place != EffectPlace::lines; }

TEST(EffectDescription, AManoeuvreHasATextAndOnlyCausesHaveAManoeuvre) {
  for (const EffectEntry& entry : effect_table()) {
    const auto effect = entry.make();
    EXPECT_EQ(effect->description().name, entry.name) << "the name of the file";
    EXPECT_EQ(!effect->description().manoeuvre.text().empty(), is_cause(effect->description())) << entry.name;
  }
  EXPECT_THROW((void)TellingManoeuvre(""), const char*);
}

TEST(EffectDescription, ConfoundersAreOtherEffectsThatCanBeACauseEachOnce) {
  std::size_t confounders = 0;
  for (const EffectEntry& entry : effect_table()) {
    const auto effect = entry.make();
    const auto& names = effect->description().confounders;
    confounders += names.size();
    EXPECT_TRUE(names.empty() || is_cause(effect->description())) << entry.name;
    for (const std::string_view name : names) {
      EXPECT_NE(name, entry.name);
      EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << entry.name << ' ' << name;
      const auto other = make_effect(name);
      ASSERT_NE(other, nullptr) << entry.name << " names " << name;
      EXPECT_TRUE(is_cause(other->description())) << entry.name << " names " << name;
    }
  }
  EXPECT_GT(confounders, 0U);
}

}  // namespace
}  // namespace navcal::sim::testing
