// SPDX-License-Identifier: Apache-2.0
#include "pipeline/system_clock_watch.h"

#include <gtest/gtest.h>

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kS = 1'000'000'000;
constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kUtc = 1'700'000'000 * kS;

SystemClockReading reading(std::int64_t second, bool synchronised, std::int64_t error_ns = 0,
                           std::int64_t shift_ns = 0) {
  return {second * kS, kUtc + second * kS + shift_ns, synchronised, error_ns};
}

TEST(SystemClockWatch, AnUnsynchronisedClockServesOnlyWhileNothingIsKnown) {
  SystemClockWatch watch;
  UtcMapping mapping;
  const auto first = watch.update(reading(1, false), mapping);
  ASSERT_TRUE(first.mapping);
  EXPECT_EQ(first.mapping->source, UtcMapping::Source::system);
  EXPECT_EQ(first.mapping->offset_ns, kUtc);
  EXPECT_EQ(first.mapping->bound_ns, UtcMapping::kUnknownBound);
  EXPECT_FALSE(watch.update(reading(2, false), *first.mapping).mapping);
  const auto better = watch.update(reading(3, true, 20 * kMs), *first.mapping);
  ASSERT_TRUE(better.mapping);
  EXPECT_EQ(better.mapping->source, UtcMapping::Source::system_synchronised);
}

TEST(SystemClockWatch, AStepIsReportedAndMovesNothing) {
  for (const std::int64_t step_ns : {3600 * kS, -3600 * kS, 20 * kMs, -20 * kMs}) {
    for (const bool synchronised : {false, true}) {
      SystemClockWatch watch;
      const UtcMapping mapping = *watch.update(reading(1, synchronised, 30 * kMs), {}).mapping;
      EXPECT_FALSE(watch.update(reading(2, synchronised, 30 * kMs), mapping).step_ns);
      const auto after = watch.update(reading(3, synchronised, 30 * kMs, step_ns), mapping);
      ASSERT_TRUE(after.step_ns);
      EXPECT_EQ(*after.step_ns, step_ns);
      EXPECT_FALSE(after.mapping);
    }
  }
}

TEST(SystemClockWatch, SlewingIsNoStep) {
  SystemClockWatch watch;
  const UtcMapping mapping = *watch.update(reading(1, true, kMs), {}).mapping;
  for (std::int64_t s = 2; s < 100; ++s) {
    EXPECT_FALSE(watch.update(reading(s, true, kMs, s * 500'000), mapping).step_ns) << s;
  }
}

TEST(SystemClockWatch, TheNarrowerBoundWinsAndBoundsGrow) {
  SystemClockWatch watch;
  UtcMapping gps{UtcMapping::Source::gps, kUtc, 60 * kMs, 0};
  EXPECT_EQ(bound_at(gps, 1000 * kS), 60 * kMs + 50 * kMs);
  EXPECT_FALSE(watch.update(reading(1, true, 100 * kMs), gps).mapping);
  const auto taken = watch.update(reading(2000, true, 100 * kMs), gps);
  ASSERT_TRUE(taken.mapping);
  EXPECT_EQ(taken.mapping->source, UtcMapping::Source::system_synchronised);
}

TEST(SystemClockWatch, ARecordingsOwnMappingIsNeverReplaced) {
  SystemClockWatch watch;
  EXPECT_FALSE(watch.update(reading(1, true, 0), {UtcMapping::Source::file, 0, 0, 0}).mapping);
}

}  // namespace
}  // namespace navcal::pipeline
