// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/advice.h"

#include <gtest/gtest.h>

#include "sim/effects/effect.h"
#include "sim/effects/effect_table.h"

namespace navcal::gap {
namespace {

TEST(Advice, ThereIsAManoeuvreForEachEffectThatCanBeACause) {
  const std::string_view none = telling_manoeuvre("no such effect");
  for (const auto& entry : sim::effect_table()) {
    if (entry.make()->description().place == sim::EffectPlace::lines) continue;
    EXPECT_NE(telling_manoeuvre(entry.name), none) << entry.name;
  }
}

TEST(Advice, WhatIsTheSameForBothIsSaidOnce) {
  EXPECT_EQ(tie_breaker("accel_bias", "accel_scale"), telling_manoeuvre("accel_bias"));
  EXPECT_NE(tie_breaker("motor_field", "hard_iron"), tie_breaker("hard_iron", "motor_field"));
}

}  // namespace
}  // namespace navcal::gap
