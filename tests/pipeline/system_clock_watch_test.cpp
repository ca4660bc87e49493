// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/durations.h"
#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kOffset_ns = 1'700'000'000 * base::kSecond_ns;

SystemClockReading reading(std::int64_t second, bool synchronised, std::int64_t error_ns = 0,
                           std::int64_t shift_ns = 0) {
  return {second * base::kSecond_ns, kOffset_ns + second * base::kSecond_ns + shift_ns, synchronised, error_ns};
}

TEST(SystemClockWatch, AnUnsynchronisedClockServesOnlyWhileNothingIsKnown) {
  SystemClockWatch watch;
  UtcMapping mapping;
  const auto first = watch.update(reading(1, false), mapping);
  ASSERT_TRUE(first.mapping);
  EXPECT_EQ(first.mapping->source, UtcMapping::Source::system);
  EXPECT_EQ(first.mapping->offset_ns, kOffset_ns);
  EXPECT_EQ(first.mapping->bound_ns, UtcMapping::kUnknownBound);
  EXPECT_FALSE(watch.update(reading(2, false), *first.mapping).mapping);
  const auto better = watch.update(reading(3, true, 20 * base::kMillisecond_ns), *first.mapping);
  ASSERT_TRUE(better.mapping);
  EXPECT_EQ(better.mapping->source, UtcMapping::Source::system_synchronised);
}

TEST(SystemClockWatch, AStepIsReportedAndMovesNothing) {
  for (const std::int64_t step_ns : {3600 * base::kSecond_ns, -3600 * base::kSecond_ns, 20 * base::kMillisecond_ns,
                                     -20 * base::kMillisecond_ns}) {
    for (const bool synchronised : {false, true}) {
      SystemClockWatch watch;
      const UtcMapping mapping = *watch.update(reading(1, synchronised, 30 * base::kMillisecond_ns), {}).mapping;
      EXPECT_FALSE(watch.update(reading(2, synchronised, 30 * base::kMillisecond_ns), mapping).step_ns);
      const auto after = watch.update(reading(3, synchronised, 30 * base::kMillisecond_ns, step_ns), mapping);
      ASSERT_TRUE(after.step_ns);
      EXPECT_EQ(*after.step_ns, step_ns);
      EXPECT_FALSE(after.mapping);
    }
  }
}

TEST(SystemClockWatch, SlewingIsNoStep) {
  SystemClockWatch watch;
  const UtcMapping mapping = *watch.update(reading(1, true, base::kMillisecond_ns), {}).mapping;
  for (std::int64_t s = 2; s < 100; ++s) {
    EXPECT_FALSE(watch.update(reading(s, true, base::kMillisecond_ns, s * 500'000), mapping).step_ns) << s;
  }
}

TEST(SystemClockWatch, TheNarrowerBoundWinsAndBoundsGrow) {
  SystemClockWatch watch;
  UtcMapping gps{UtcMapping::Source::gps, kOffset_ns, 60 * base::kMillisecond_ns, 0};
  EXPECT_EQ(bound_at(gps, 1000 * base::kSecond_ns), 60 * base::kMillisecond_ns + 50 * base::kMillisecond_ns);
  EXPECT_FALSE(watch.update(reading(1, true, 100 * base::kMillisecond_ns), gps).mapping);
  const auto taken = watch.update(reading(2000, true, 100 * base::kMillisecond_ns), gps);
  ASSERT_TRUE(taken.mapping);
  EXPECT_EQ(taken.mapping->source, UtcMapping::Source::system_synchronised);
}

TEST(SystemClockWatch, ARecordingsOwnMappingIsNeverReplaced) {
  SystemClockWatch watch;
  EXPECT_FALSE(watch.update(reading(1, true, 0), {UtcMapping::Source::file, 0, 0, 0}).mapping);
}

TEST(SystemClockWatch, AClockThatWasNeverSetIsNotUtc) {
  for (const bool synchronised : {false, true}) {
    SystemClockWatch watch;
    const SystemClockReading in_1970{20 * base::kSecond_ns, 32 * base::kSecond_ns, synchronised, 0};
    EXPECT_FALSE(watch.update(in_1970, {}).mapping);
    const auto set = watch.update(reading(21, synchronised), {});
    EXPECT_TRUE(set.mapping) << "once it is set, it serves";
    EXPECT_TRUE(set.step_ns);
  }
}

}  // namespace
}  // namespace navcal::pipeline
