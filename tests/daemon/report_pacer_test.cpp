// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "daemon/report_class.h"

namespace navcal::daemon {
namespace {

constexpr std::int64_t kPacerMillisecond_ns = 1'000'000;

/// Reports come every `period_ns` for a minute, in turn on time and late by `jitter_ns`: how many pass.
int reports_passed(std::int64_t period_ns, std::int64_t interval_ns, std::int64_t jitter_ns) {
  ReportPacer pacer;
  int count = 0;
  for (std::int64_t i = 0; i * period_ns < 60'000 * kPacerMillisecond_ns; ++i)
    count += pacer.take(ReportClass::att, 0, interval_ns, i * period_ns + (i % 3) * jitter_ns) ? 1 : 0;
  return count;
}

TEST(ReportPacer, TheRateIsKeptOnAverage) {
  EXPECT_NEAR(reports_passed(100 * kPacerMillisecond_ns, 500 * kPacerMillisecond_ns, 0), 120, 1);
  EXPECT_NEAR(reports_passed(10 * kPacerMillisecond_ns, 33 * kPacerMillisecond_ns, kPacerMillisecond_ns),
              60'000 / 33, 2);
}

TEST(ReportPacer, ADeviceAtJustTheRateIsNotHalvedByItsJitter) {
  EXPECT_GE(reports_passed(100 * kPacerMillisecond_ns, 100 * kPacerMillisecond_ns, 20 * kPacerMillisecond_ns),
            598);
  EXPECT_LE(reports_passed(99 * kPacerMillisecond_ns, 100 * kPacerMillisecond_ns, 20 * kPacerMillisecond_ns), 601);
}

TEST(ReportPacer, APauseIsNotMadeUpFor) {
  ReportPacer pacer;
  EXPECT_TRUE(pacer.take(ReportClass::att, 0, 100 * kPacerMillisecond_ns, 0));
  int count = 0;
  for (int i = 0; i < 100; ++i)
    count +=
        pacer.take(ReportClass::att, 0, 100 * kPacerMillisecond_ns, 60'000 * kPacerMillisecond_ns + i) ? 1 : 0;
  EXPECT_LE(count, 2);
}

TEST(ReportPacer, EachClassAndEachSlotHasItsOwnTurn) {
  ReportPacer pacer;
  EXPECT_TRUE(pacer.take(ReportClass::att, 0, 1000 * kPacerMillisecond_ns, 0));
  EXPECT_FALSE(pacer.take(ReportClass::att, 0, 1000 * kPacerMillisecond_ns, 1));
  EXPECT_TRUE(pacer.take(ReportClass::att, 1, 1000 * kPacerMillisecond_ns, 1));
  EXPECT_TRUE(pacer.take(ReportClass::tpv, 0, 1000 * kPacerMillisecond_ns, 1));
  EXPECT_FALSE(pacer.is_due(ReportClass::tpv, 0, 1000 * kPacerMillisecond_ns, 2));
  pacer.forget();
  EXPECT_TRUE(pacer.is_due(ReportClass::tpv, 0, 1000 * kPacerMillisecond_ns, 2));
}

}  // namespace
}  // namespace navcal::daemon
