// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/allan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

/// The definition, from means of 2m readings anew at each place.
double allan_by_definition(const Pieces& pieces, std::size_t m) {
  double squares = 0, places = 0;
  for (const auto& y : pieces) {
    for (std::size_t first = 0; first + 2 * m <= y.size(); ++first) {
      double before = 0, after = 0;
      for (std::size_t i = 0; i < m; ++i) {
        before += y[first + i] / static_cast<double>(m);
        after += y[first + m + i] / static_cast<double>(m);
      }
      squares += (after - before) * (after - before);
      ++places;
    }
  }
  return std::sqrt(squares / (2 * places));
}

TEST(AllanDeviation, IsThatOfTheDefinition) {
  noise_test::MadeNoise noise(1);
  for (const std::size_t count : {2UL, 3UL, 17UL, 300UL}) {
    Pieces pieces{noise_test::sum(noise.white(count, 0.3), noise.walk(count, 0.05))};
    for (auto& value : pieces[0]) value += 1000;
    if (count == 300) pieces.push_back(noise.white(77, 1));
    const auto points = allan_deviation(pieces, 0.02);
    ASSERT_FALSE(points.empty());
    EXPECT_LE(2 * points.back().factor, count);
    EXPECT_GT(4 * points.back().factor, count);
    for (const auto& point : points) {
      EXPECT_DOUBLE_EQ(point.tau_s, 0.02 * static_cast<double>(point.factor));
      EXPECT_NEAR(point.deviation / allan_by_definition(pieces, point.factor), 1, 1e-9) << point.factor;
    }
  }
}

// NIST SP 1065, section 12.4: the ten values of its small test suite.
TEST(AllanDeviation, IsThatOfThePublishedExample) {
  const Pieces pieces{{892, 809, 823, 798, 671, 644, 883, 903, 677}};
  const auto points = allan_deviation(pieces, 1);
  ASSERT_GE(points.size(), 2U);
  EXPECT_NEAR(points[0].deviation, 91.22945, 5e-6);
  EXPECT_NEAR(points[1].deviation, 85.95287, 5e-6);
}

TEST(AllanDeviation, NothingFromTooFewReadings) {
  EXPECT_TRUE(allan_deviation({}, 1).empty());
  EXPECT_TRUE(allan_deviation({{1.0}}, 1).empty());
  EXPECT_TRUE(allan_deviation({{1.0, 2.0, 3.0}}, 0).empty());
  EXPECT_EQ(allan_deviation({{1.0, 2.0}}, 1).size(), 1U);
}

/// Makes readings again and again: degrees of freedom are 2 mean^2 / variance of the Allan variance.
void expect_freedom(NoiseKind kind, std::size_t factor, const std::function<std::vector<double>(unsigned)>& make) {
  constexpr unsigned kTrials = 1500;
  double mean = 0, squares = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const Pieces pieces{make(seed)};
    for (const auto& point : allan_deviation(pieces, 1)) {
      if (point.factor != factor) continue;
      const double variance = point.deviation * point.deviation, departure = variance - mean;
      mean += departure / (seed + 1);
      squares += departure * (variance - mean);
    }
  }
  const double measured = 2 * mean * mean / (squares / (kTrials - 1));
  EXPECT_NEAR(allan_edf(kind, make(0).size(), factor) / measured, 1, 0.2)
      << static_cast<int>(kind) << " " << factor;
}

TEST(AllanDeviation, DegreesOfFreedomAreThoseOfManyRecordings) {
  constexpr std::size_t kReadings = 256;
  for (const std::size_t factor : {1UL, 4UL, 32UL}) {
    expect_freedom(NoiseKind::white, factor,
                   [](unsigned seed) { return noise_test::MadeNoise(seed).white(kReadings, 2); });
    expect_freedom(NoiseKind::flicker, factor,
                   [](unsigned seed) { return noise_test::MadeNoise(seed).flicker(kReadings, 2); });
    expect_freedom(NoiseKind::random_walk, factor,
                   [](unsigned seed) { return noise_test::MadeNoise(seed).walk(kReadings, 2); });
  }
}

TEST(AllanDeviation, TheIntervalHoldsTheTruthIn95Percent) {
  constexpr int kTrials = 1000;
  int held[3] = {0, 0, 0};
  const std::size_t factors[3] = {1, 8, 64};
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const auto points = allan_deviation({noise_test::MadeNoise(seed).white(500, 1)}, 1);
    for (int i = 0; i < 3; ++i) {
      for (const auto& point : points) {
        const double truth = 1 / std::sqrt(static_cast<double>(point.factor));
        if (point.factor == factors[i]) held[i] += point.low <= truth && truth <= point.high ? 1 : 0;
      }
    }
  }
  // The chance of a share outside these bounds is below 1e-4 where it is 95 %.
  for (const int count : held) {
    EXPECT_GE(count, 920);
    EXPECT_LE(count, 976);
  }
}

TEST(AllanDeviation, NoIntervalReachesOverAGap) {
  noise_test::MadeNoise noise(5);
  auto before = noise.white(200, 1), after = noise.white(200, 1);
  const auto apart = allan_deviation({before, after}, 1);
  for (double& value : after) value += 1000;
  const auto shifted = allan_deviation({before, after}, 1);
  ASSERT_EQ(apart.size(), shifted.size());
  for (std::size_t i = 0; i < apart.size(); ++i) EXPECT_NEAR(apart[i].deviation, shifted[i].deviation, 1e-9);
}

}  // namespace
}  // namespace navcal::analysis
