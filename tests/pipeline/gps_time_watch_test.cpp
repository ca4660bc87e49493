// SPDX-License-Identifier: Apache-2.0
#include "pipeline/gps_time_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/durations.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kUtc = 1'700'000'000 * base::kSecond_ns;

TEST(GpsTimeWatch, FindsTheMappingThroughTheDelaysOfTheHost) {
  std::mt19937_64 random(4);
  std::exponential_distribution<double> delay_s(1 / 5e-3);
  GpsTimeWatch watch(0.020);
  UtcMapping mapping{UtcMapping::Source::system, kUtc + 12345678, UtcMapping::kUnknownBound, 0};
  for (int k = 10; k < 200; ++k) {
    const auto observed_ns = k * base::kSecond_ns + std::llround(delay_s(random) * 1e9);
    if (const auto better = watch.update(kUtc + k * base::kSecond_ns, observed_ns, mapping)) mapping = *better;
  }
  EXPECT_EQ(mapping.source, UtcMapping::Source::gps);
  EXPECT_LT(std::abs(mapping.offset_ns - kUtc), 3'000'000);
  EXPECT_NEAR(static_cast<double>(mapping.bound_ns), 60e6, 10e6);
}

TEST(GpsTimeWatch, ALeapSecondLearntMovesTheMapping) {
  GpsTimeWatch watch(0.020);
  UtcMapping mapping;
  for (int k = 10; k < 40; ++k) {
    if (const auto better = watch.update(kUtc + (k + 18) * base::kSecond_ns, k * base::kSecond_ns, mapping))
      mapping = *better;
  }
  EXPECT_NEAR(static_cast<double>(mapping.offset_ns - kUtc) * 1e-9, 18, 0.01);
  for (int k = 40; k < 80; ++k) {
    if (const auto better = watch.update(kUtc + k * base::kSecond_ns, k * base::kSecond_ns, mapping))
      mapping = *better;
  }
  EXPECT_NEAR(static_cast<double>(mapping.offset_ns - kUtc) * 1e-9, 0, 0.01);
}

TEST(GpsTimeWatch, ALeapSecondMovesTheMappingWithTheFirstMessageBehindIt) {
  constexpr std::int64_t kMidnight = 1'735'689'600;  // 2025-01-01
  for (const std::int64_t leap_s : {0, 1}) {
    GpsTimeWatch watch(0.020);
    UtcMapping mapping;
    for (int k = -30; k < 30; ++k) {
      const bool in_leap_second = leap_s == 1 && k == 0;
      const std::int64_t stated = (kMidnight + k - (k > 0 ? leap_s : 0)) * base::kSecond_ns;
      const std::int64_t observed_ns = (100 + k) * base::kSecond_ns;
      if (const auto better = watch.update(stated, observed_ns, mapping, in_leap_second)) mapping = *better;
      if (k < -20) continue;
      EXPECT_LT(std::abs(mapping.to_utc(observed_ns) - stated), 10'000'000) << k;
      EXPECT_EQ(mapping.bound_ns > base::kSecond_ns, in_leap_second) << k;
    }
  }
}

/// A receiver whose clock is not steered measures beside the second, and says by how much.
TEST(GpsTimeWatch, AnEpochBesideTheSecondCountsByItsStatedTime) {
  std::optional<std::int64_t> offset_ns;  // of a receiver that measures at the second
  for (const std::int64_t beside_ns : {0LL, -400'000LL, 52'000LL, 1'900'000LL}) {
    GpsTimeWatch watch(0.020);
    UtcMapping mapping;
    for (int k = 10; k < 40; ++k) {
      for (const std::int64_t part_ns : {0LL, 250'000'000LL, 500'000'000LL, 750'000'000LL}) {
        const std::int64_t epoch_ns = k * base::kSecond_ns + part_ns + beside_ns;
        if (const auto better = watch.update(kUtc + epoch_ns, epoch_ns, mapping)) mapping = *better;
      }
    }
    EXPECT_EQ(mapping.source, UtcMapping::Source::gps) << beside_ns;
    if (!offset_ns) offset_ns = mapping.offset_ns;
    EXPECT_EQ(mapping.offset_ns, *offset_ns) << beside_ns;
    EXPECT_LT(std::abs(mapping.offset_ns - kUtc), 1'000'000) << beside_ns;
  }
}

TEST(GpsTimeWatch, EpochsBetweenTheSecondsAreLeftOut) {
  GpsTimeWatch watch(0.020);
  const UtcMapping mapping;
  for (int k = 10; k < 40; ++k) {
    const std::int64_t epoch_ns = k * base::kSecond_ns + 100'000'000;
    EXPECT_FALSE(watch.update(kUtc + epoch_ns, epoch_ns, mapping));
  }
}

/// Whenever the host stands still, one or two messages are read late; no mapping may follow them.
TEST(GpsTimeWatch, AHostThatStoodStillMovesNothing) {
  for (int stall_at = 10; stall_at < 60; ++stall_at) {
    for (const double stall_s : {0.3, 0.95, 1.4, 1.875}) {
      GpsTimeWatch watch(0.020);
      UtcMapping mapping;
      for (int k = 10; k < 120; ++k) {
        const double late_s = std::max(0.0, stall_at + stall_s - k) * (k >= stall_at ? 1 : 0) + 1e-3 * (k % 3);
        const auto better =
            watch.update(kUtc + k * base::kSecond_ns, k * base::kSecond_ns + std::llround(late_s * 1e9), mapping);
        if (!better) continue;
        mapping = *better;
        ASSERT_LT(std::abs(mapping.offset_ns - kUtc), mapping.bound_ns)
            << "stood still for " << stall_s << " s at " << stall_at << ", mapping of " << k;
      }
      EXPECT_EQ(mapping.source, UtcMapping::Source::gps);
    }
  }
}

TEST(GpsTimeWatch, NarrowerMappingsStay) {
  GpsTimeWatch watch(0.020);
  const UtcMapping ntp{UtcMapping::Source::system_synchronised, kUtc, 1'000'000, 0};
  const UtcMapping file{UtcMapping::Source::file, 0, 0, 0};
  for (int k = 10; k < 60; ++k) {
    EXPECT_FALSE(watch.update(kUtc + k * base::kSecond_ns, k * base::kSecond_ns, k % 2 == 0 ? ntp : file));
  }
}

TEST(GpsTimeWatch, TwoReceiversThatDisagreeDoNotTakeTurns) {
  for (const double second_std_s : {0.020, 0.015, 0.005}) {
    GpsTimeWatch first(0.020), second(second_std_s);
    UtcMapping mapping{UtcMapping::Source::none, 0, UtcMapping::kUnknownBound, 0};
    int changes = 0;
    std::int64_t offset_ns = 0;
    const auto take = [&](const std::optional<UtcMapping>& found) {
      if (!found) return;
      changes += std::abs(found->offset_ns - offset_ns) > 50'000'000 ? 1 : 0;
      mapping = *found;
      offset_ns = found->offset_ns;
    };
    for (std::int64_t k = 10; k < 600; ++k) {
      take(first.update(kUtc + k * base::kSecond_ns, k * base::kSecond_ns, mapping));
      const std::int64_t late_ns = k * base::kSecond_ns + 300'000'000;
      if (k > 20) take(second.update(kUtc + k * base::kSecond_ns, late_ns, mapping));
    }
    EXPECT_LE(changes, second_std_s < 0.01 ? 2 : 1) << second_std_s;
    // The one that fell silent is replaced.
    for (std::int64_t k = 600; k < 900; ++k) {
      const std::int64_t late_ns = k * base::kSecond_ns + 300'000'000;
      take(second.update(kUtc + k * base::kSecond_ns, late_ns, mapping));
    }
    EXPECT_NEAR(static_cast<double>(mapping.offset_ns - kUtc), -0.3e9, 0.1e9) << second_std_s;
  }
}

TEST(GpsTimeWatch, RepeatedAndBackwardTimesDoNoHarm) {
  GpsTimeWatch watch(0.020);
  UtcMapping mapping;
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> anything(-5, 5000);
  for (int k = 10; k < 500; ++k) {
    const auto second = random() % 4 == 0 ? anything(random) : k;
    (void)watch.update(kUtc + second * base::kSecond_ns, k * base::kSecond_ns, mapping);
  }
  for (int k = 500; k < 540; ++k) {
    if (const auto better = watch.update(kUtc + k * base::kSecond_ns, k * base::kSecond_ns, mapping))
      mapping = *better;
  }
  EXPECT_NEAR(static_cast<double>(mapping.offset_ns - kUtc) * 1e-9, 0, 0.05);
}

}  // namespace
}  // namespace navcal::pipeline
