// SPDX-License-Identifier: Apache-2.0
#include "config/units.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <random>

namespace navcal::config {
namespace {

TEST(ConfigUnits, FileToInside) {
  EXPECT_EQ(to_inside<double>(50, kMilliseconds), 0.050);
  EXPECT_EQ(to_inside<double>(24, kHours), 86400);
  EXPECT_EQ(to_inside<double>(180, kDegrees), std::numbers::pi);
  EXPECT_EQ(to_inside<std::uint64_t>(512, kMegabytes), 512'000'000U);
  EXPECT_EQ(to_inside<std::uint64_t>(0.0000014, kMegabytes), 1U);
}

TEST(ConfigUnits, InsideToFileIsTheShortestNumberThatReadsBack) {
  EXPECT_EQ(to_file(0.050, kMilliseconds), 50);
  EXPECT_EQ(to_file(0.0005, kMilliseconds), 0.5);
  EXPECT_EQ(to_file(std::uint64_t{1}, kMegabytes), 0.000001);
  EXPECT_EQ(to_file(to_inside<double>(1.81, kDegrees), kDegrees), 1.81);
}

TEST(ConfigUnits, WhateverAFileStatesReadsBackToTheLastBit) {
  std::mt19937_64 random(1);  // NOLINT: the same numbers in every run
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int i = 0; i < 5000; ++i) {
    const double stated = std::ldexp(mantissa(random), exponent(random));
    for (const Unit& unit : {kSeconds, kMilliseconds, kHours, kDegrees}) {
      const auto inside = to_inside<double>(stated, unit);
      ASSERT_EQ(to_inside<double>(to_file(inside, unit), unit), inside) << stated << ' ' << unit.name;
    }
  }
}

TEST(ConfigUnits, EveryNumberOfBytesReadsBack) {
  std::mt19937_64 random(2);  // NOLINT: the same numbers in every run
  std::uniform_int_distribution<std::uint64_t> bytes(0, 1'000'000'000'000'000);
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t inside = bytes(random);
    ASSERT_EQ(to_inside<std::uint64_t>(to_file(inside, kMegabytes), kMegabytes), inside);
  }
}

}  // namespace
}  // namespace navcal::config
