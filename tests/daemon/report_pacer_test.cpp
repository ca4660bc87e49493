// SPDX-License-Identifier: Apache-2.0
#include "daemon/report_pacer.h"

#include <gtest/gtest.h>

namespace navcal::daemon {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Of reports every `period_ns`, late by turns as `jitter_ns` says, for a minute: how many pass.
int passed(std::int64_t period_ns, std::int64_t interval_ns, std::int64_t jitter_ns) {
  ReportPacer pacer;
  int count = 0;
  for (std::int64_t i = 0; i * period_ns < 60'000 * kMs; ++i)
    count += pacer.take(ReportClass::att, 0, interval_ns, i * period_ns + (i % 3) * jitter_ns) ? 1 : 0;
  return count;
}

TEST(ReportPacer, TheRateIsKeptOnAverage) {
  EXPECT_NEAR(passed(100 * kMs, 500 * kMs, 0), 120, 1);
  EXPECT_NEAR(passed(10 * kMs, 33 * kMs, kMs), 60'000 / 33, 2);
}

TEST(ReportPacer, ADeviceAtJustTheRateIsNotHalvedByItsJitter) {
  EXPECT_GE(passed(100 * kMs, 100 * kMs, 20 * kMs), 598);
  EXPECT_LE(passed(99 * kMs, 100 * kMs, 20 * kMs), 601);
}

TEST(ReportPacer, APauseIsNotMadeUpFor) {
  ReportPacer pacer;
  EXPECT_TRUE(pacer.take(ReportClass::att, 0, 100 * kMs, 0));
  int count = 0;
  for (int i = 0; i < 100; ++i) count += pacer.take(ReportClass::att, 0, 100 * kMs, 60'000 * kMs + i) ? 1 : 0;
  EXPECT_LE(count, 2);
}

TEST(ReportPacer, EachClassAndEachSlotHasItsOwnTurn) {
  ReportPacer pacer;
  EXPECT_TRUE(pacer.take(ReportClass::att, 0, 1000 * kMs, 0));
  EXPECT_FALSE(pacer.take(ReportClass::att, 0, 1000 * kMs, 1));
  EXPECT_TRUE(pacer.take(ReportClass::att, 1, 1000 * kMs, 1));
  EXPECT_TRUE(pacer.take(ReportClass::tpv, 0, 1000 * kMs, 1));
  EXPECT_FALSE(pacer.is_due(ReportClass::tpv, 0, 1000 * kMs, 2));
  pacer.forget();
  EXPECT_TRUE(pacer.is_due(ReportClass::tpv, 0, 1000 * kMs, 2));
}

}  // namespace
}  // namespace navcal::daemon
