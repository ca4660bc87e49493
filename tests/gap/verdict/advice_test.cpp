// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gap/verdict/answer.h"

namespace navcal::gap {
namespace {

sim::EffectDescription told_by(const char* manoeuvre) { return sim::described("", "", {}, manoeuvre); }

TEST(TieBreaker, NamesTheManoeuvreOfEachEffectInOrder) {
  EXPECT_EQ(tie_breaker(told_by("climb"), told_by("turn")), "climb; and turn");
  EXPECT_EQ(tie_breaker(told_by("turn"), told_by("climb")), "turn; and climb");
}

TEST(TieBreaker, NamesACommonManoeuvreOnce) { EXPECT_EQ(tie_breaker(told_by("turn"), told_by("turn")), "turn"); }

}  // namespace
}  // namespace navcal::gap
