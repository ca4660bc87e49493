// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/allan_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

constexpr double kPeriod_s = 0.02;

AllanFit fit_of(const std::vector<double>& readings, const std::vector<SpectralLine>& lines = {}) {
  const Pieces pieces{readings};
  auto points = allan_deviation(pieces, kPeriod_s);
  return fit_allan(points, pieces, kPeriod_s, kPeriod_s, 0, lines);
}

struct Tally {
  int found = 0, within = 0;  ///< within 1.96 standard errors of the truth
  void add(const NoiseTerm& term, double truth) {
    if (!term.value) return;
    ++found;
    within += std::abs(*term.value - truth) < 1.96 * *term.error ? 1 : 0;
  }
};

TEST(AllanFit, WhiteNoiseIsWithinItsErrorInNineteenOfTwenty) {
  constexpr int kTrials = 400;
  Tally white;
  int flicker = 0, walk = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const auto fit = fit_of(noise_test::MadeNoise(seed).white(2000, 0.1));
    white.add(fit.white, 0.1 * std::sqrt(kPeriod_s));
    flicker += fit.flicker.value ? 1 : 0;
    walk += fit.walk.value ? 1 : 0;
  }
  EXPECT_EQ(white.found, kTrials);
  // Three standard deviations of the share about 95 %.
  EXPECT_GE(white.within, 0.917 * kTrials);
  EXPECT_LE(white.within, 0.983 * kTrials);
  // Terms that are not there.
  EXPECT_LE(flicker, 0.02 * kTrials);
  EXPECT_LE(walk, 0.02 * kTrials);
}

TEST(AllanFit, ARandomWalkBesideWhiteNoiseIsFoundWithItsError) {
  constexpr int kTrials = 200;
  const double walk = 0.02;  // unit / sqrt(s)
  Tally white, found;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    noise_test::MadeNoise noise(seed);
    const auto fit =
        fit_of(noise_test::sum(noise.white(20000, 0.1), noise.walk(20000, walk * std::sqrt(kPeriod_s))));
    white.add(fit.white, 0.1 * std::sqrt(kPeriod_s));
    found.add(fit.walk, walk);
  }
  EXPECT_EQ(white.found, kTrials);
  EXPECT_GE(white.within, 0.90 * kTrials);
  EXPECT_GE(found.found, 0.95 * kTrials);
  EXPECT_GE(found.within, 0.88 * found.found);
}

TEST(AllanFit, ARandomWalkAloneLeavesNoWhiteNoise) {
  constexpr int kTrials = 200;
  int white = 0;
  Tally walk;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const auto fit = fit_of(noise_test::MadeNoise(seed).walk(5000, 1));
    white += fit.white.value ? 1 : 0;
    walk.add(fit.walk, 1 / std::sqrt(kPeriod_s));
  }
  EXPECT_LE(white, 0.02 * kTrials);
  EXPECT_EQ(walk.found, kTrials);
  EXPECT_GE(walk.within, 0.90 * kTrials);
}

TEST(AllanFit, FlickerNoiseIsBiasInstability) {
  constexpr int kTrials = 60;
  double mean = 0;
  int found = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    noise_test::MadeNoise noise(seed);
    const auto fit = fit_of(noise_test::sum(noise.white(20000, 0.1), noise.flicker(20000, 0.02)));
    if (!fit.flicker.value) continue;
    ++found;
    mean += *fit.flicker.value;
  }
  ASSERT_GE(found, 0.8 * kTrials);
  EXPECT_NEAR(mean / found, 0.02, 0.002);
}

TEST(AllanFit, WhatIsNotSeenHasALimitAndALength) {
  const auto fit = fit_of(noise_test::MadeNoise(7).white(3000, 0.1));
  EXPECT_FALSE(fit.flicker.value);
  ASSERT_TRUE(fit.flicker.limit && fit.flicker.needs_s);
  EXPECT_LT(*fit.flicker.limit, 0.02);
  EXPECT_GE(*fit.flicker.needs_s, 60);
  ASSERT_TRUE(fit.walk.limit && fit.walk.needs_s);
  // A walk as large as the limit is found in a recording of the length that is named, about as often as not.
  int found = 0;
  const auto length = static_cast<std::size_t>(*fit.walk.needs_s / kPeriod_s);
  for (unsigned seed = 0; seed < 40; ++seed) {
    noise_test::MadeNoise noise(seed);
    const auto walk = noise.walk(length, *fit.walk.limit * std::sqrt(kPeriod_s));
    found += fit_of(noise_test::sum(noise.white(length, 0.1), walk)).walk.value ? 1 : 0;
  }
  EXPECT_GE(found, 12);
}

TEST(AllanFit, AFewReadingsNeedMore) {
  const auto fit = fit_of({1, 2, 1.5});
  for (const auto* term : {&fit.white, &fit.flicker, &fit.walk}) {
    EXPECT_FALSE(term->value);
    EXPECT_EQ(term->needs_s, 64 * kPeriod_s);
  }
}

TEST(AllanFit, AKnownLineIsNotTakenForNoise) {
  noise_test::MadeNoise noise(4);
  const auto readings = noise_test::sum(noise.white(20000, 0.1), noise_test::sine(20000, 0.5, 0.24));
  const auto fit = fit_of(readings, {{0.24 / kPeriod_s, 0.5}});
  ASSERT_TRUE(fit.white.value);
  EXPECT_NEAR(*fit.white.value, 0.1 * std::sqrt(kPeriod_s), 0.1 * std::sqrt(kPeriod_s) * 0.03);
}

}  // namespace
}  // namespace navcal::analysis
