// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/reading_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/noise/channel_noise.h"
#include "analysis/noise/series.h"
#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

TEST(ReadingNoise, OfWhiteNoiseIsWithinItsErrorInNineteenOfTwenty) {
  constexpr int kTrials = 1000;
  int within = 0, correlated = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const auto noise = reading_noise({noise_test::MadeNoise(seed).white(400, 2)}, 1, {});
    ASSERT_TRUE(noise);
    within += std::abs(noise->std - 2) < 1.96 * noise->std_error ? 1 : 0;
    correlated += noise->correlated ? 1 : 0;
  }
  EXPECT_GE(within, 0.929 * kTrials);
  EXPECT_LE(within, 0.971 * kTrials);
  EXPECT_LE(correlated, 2);
}

TEST(ReadingNoise, ASwingWhoseReadingsAllFollowTheOneBeforeEnds) {
  // Its correlation is one, so that no lag would ever be long enough.
  std::vector<double> swing;
  for (int i = 0; i < 300; ++i) swing.push_back(std::sin(i * std::numbers::pi / 3));
  const auto noise = reading_noise({swing}, 0.1, {});
  ASSERT_TRUE(noise);
  EXPECT_TRUE(std::isfinite(noise->std));
  EXPECT_FALSE(noise->time_constant_s);
}

TEST(ReadingNoise, AFilterShowsItsTimeConstant) {
  for (const double a : {0.3, 0.6, 0.8}) {
    const auto noise = reading_noise({noise_test::MadeNoise(1).filtered(20000, 2, a)}, 0.1, {});
    ASSERT_TRUE(noise);
    EXPECT_TRUE(noise->correlated) << a;
    EXPECT_FALSE(noise->drifts);
    EXPECT_NEAR(noise->std, 2, 0.1) << a;
    ASSERT_TRUE(noise->time_constant_s);
    EXPECT_NEAR(*noise->time_constant_s, -0.1 / std::log(a), 0.015 / std::abs(std::log(a))) << a;
  }
}

TEST(ReadingNoise, ADriftIsNoFilter) {
  const auto noise = reading_noise({noise_test::MadeNoise(1).walk(2000, 1)}, 0.1, {});
  ASSERT_TRUE(noise);
  EXPECT_TRUE(noise->drifts);
  EXPECT_FALSE(noise->correlated);
}

TEST(ReadingNoise, NothingFromTooFewOrEqualReadings) {
  EXPECT_FALSE(reading_noise({}, 1, {}));
  EXPECT_FALSE(reading_noise({{1, 2, 3}}, 1, {}));
  EXPECT_FALSE(reading_noise({std::vector<double>(100, 4.0)}, 1, {}));
}

TEST(Resolution, TheStepIsFoundWhereverItsMultiplesLie) {
  for (const double step : {0.1, 0.01, 1.0, 360.0 / 65536, 0.0625 / 187.5}) {
    for (const double std_steps : {0.4, 3.0, 200.0}) {
      auto values = noise_test::rounded(noise_test::MadeNoise(1).white(3000, std_steps * step), step);
      for (double& value : values) value = (value + 7 * step) * 1.7453 / 1.7453;
      const auto found = resolution_of(values);
      ASSERT_TRUE(found) << step << " " << std_steps;
      EXPECT_NEAR(*found / step, 1, 1e-6) << step << " " << std_steps;
    }
  }
}

TEST(Resolution, LevelsThatAreFarApartHaveACommonDivisor) {
  EXPECT_NEAR(resolution_of({0.0, 0.2, 0.5, 0.2}).value_or(0), 0.1, 1e-12);
  EXPECT_NEAR(resolution_of({3.0, 4.0, 3.0}).value_or(0), 1, 1e-12);
}

TEST(Resolution, OfSinglePrecisionToo) {
  auto values = noise_test::rounded(noise_test::MadeNoise(2).white(500, 1), 0.1);
  for (double& value : values) value = static_cast<double>(static_cast<float>(value + 120));
  EXPECT_NEAR(resolution_of(values).value_or(0), 0.1, 1e-5);
}

TEST(Resolution, NoneOfContinuousReadingsNorOfOneValue) {
  int by_chance = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    for (const std::size_t count : {4UL, 10UL, 5000UL})
      EXPECT_FALSE(resolution_of(noise_test::MadeNoise(seed).white(count, 1))) << seed << " " << count;
    by_chance += resolution_of(noise_test::MadeNoise(seed).white(3, 1)) ? 1 : 0;  // two differences: 2 %
  }
  EXPECT_LE(by_chance, 5);
  EXPECT_FALSE(resolution_of({}));
  EXPECT_FALSE(resolution_of({5.0, 5.0}));
}

TEST(ChannelNoise, RoundingIsToldApart) {
  const double step = 0.1;
  for (const double std : {0.06, 0.1, 0.3}) {
    noise_test::MadeNoise made(3);
    auto values = made.white(20000, std);
    for (double& value : values) value += 0.037;
    const auto noise = channel_noise(noise_test::series_of(noise_test::rounded(values, step), 0.1), {{0, 1e9}});
    ASSERT_TRUE(noise.resolution && noise.unrounded);
    EXPECT_NEAR(*noise.resolution, step, 1e-9);
    EXPECT_NEAR(*noise.unrounded, std, 3 * *noise.unrounded_error + 0.02 * std) << std;
    EXPECT_GT(noise.reading->std, *noise.unrounded);
  }
}

TEST(ChannelNoise, NoiseFarBelowTheStepIsNotStated) {
  auto values = noise_test::MadeNoise(3).white(5000, 0.02);
  for (double& value : values) value += 0.05;
  const auto noise = channel_noise(noise_test::series_of(noise_test::rounded(values, 0.1), 0.1), {{0, 1e9}});
  ASSERT_TRUE(noise.reading);
  EXPECT_FALSE(noise.unrounded);
  EXPECT_FALSE(noise.to_reckon());
}

TEST(ChannelNoise, AConstantChannelIsCalledConstant) {
  const auto noise = channel_noise(noise_test::series_of(std::vector<double>(500, 21.0), 0.1), {{0, 1e9}});
  EXPECT_TRUE(noise.constant);
  EXPECT_FALSE(noise.reading);
  EXPECT_TRUE(noise.allan.empty());
}

TEST(ChannelNoise, CorrelatedReadingsHaveTheirEffectiveNoise) {
  constexpr int kTrials = 40;
  const double a = 0.7;
  int within = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const auto noise = channel_noise(
        noise_test::series_of(noise_test::MadeNoise(seed).filtered(20000, 0.2, a), 0.0625), {{0, 1e9}});
    ASSERT_TRUE(noise.reading && noise.reading->correlated && noise.effective);
    within +=
        std::abs(*noise.effective - 0.2 * std::sqrt((1 + a) / (1 - a))) < 1.96 * *noise.effective_error ? 1 : 0;
    EXPECT_EQ(noise.to_reckon(), noise.effective);
  }
  EXPECT_GE(within, 0.85 * kTrials);
}

TEST(ChannelNoise, ReadingsThatEachComeTwiceHaveWhiteNoiseToo) {
  int without_filter = 0;  // their correlation is estimated as one or more
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto fresh = noise_test::MadeNoise(seed).white(2000, 0.1);
    std::vector<double> values;
    for (const double value : fresh) values.insert(values.end(), 2, value);
    const auto noise = channel_noise(noise_test::series_of(values, 0.02), {{0, 1e9}});
    ASSERT_TRUE(noise.reading && noise.reading->correlated);
    if (noise.reading->time_constant_s) continue;
    ++without_filter;
    ASSERT_TRUE(noise.terms.white.value) << seed;
    EXPECT_NEAR(*noise.terms.white.value, 0.1 * std::sqrt(0.04), 0.1 * 0.1 * std::sqrt(0.04)) << seed;
  }
  EXPECT_GT(without_filter, 0);
}

TEST(ChannelNoise, TwoStretchesAndAGapGiveTheNoiseOfBoth) {
  noise_test::MadeNoise made(9);
  Series series = noise_test::series_of(made.white(4000, 0.1), 0.02);
  const Series later = noise_test::series_of(made.white(4000, 0.1), 0.02, 300);
  series.time_s.insert(series.time_s.end(), later.time_s.begin(), later.time_s.end());
  for (const double value : later.values) series.values.push_back(value + 50);
  const auto noise = channel_noise(series, {{0, 1e9}});
  EXPECT_EQ(noise.stretches, 2U);
  EXPECT_EQ(noise.readings, 8000U);
  EXPECT_NEAR(noise.seconds, 160, 0.1);
  ASSERT_TRUE(noise.reading && noise.terms.white.value);
  EXPECT_NEAR(noise.reading->std, 0.1, 4 * noise.reading->std_error);
  EXPECT_NEAR(*noise.terms.white.value, 0.1 * std::sqrt(0.02), 4 * *noise.terms.white.error);
  EXPECT_FALSE(noise.terms.walk.value);
}

TEST(ChannelNoise, NothingFromNoReadings) {
  EXPECT_EQ(channel_noise({}, {{0, 10}}).readings, 0U);
  EXPECT_EQ(channel_noise(noise_test::series_of({1, 2, 3}, 1), {}).readings, 0U);
  const auto three = channel_noise(noise_test::series_of({1, 2.5, 3}, 1), {{0, 10}});
  EXPECT_EQ(three.readings, 3U);
  EXPECT_FALSE(three.to_reckon());
  // Times that do not advance.
  Series still{{1, 1, 1, 1}, {1, 2, 3, 4}};
  EXPECT_FALSE(channel_noise(still, {{0, 10}}).reading);
}

}  // namespace
}  // namespace navcal::analysis
