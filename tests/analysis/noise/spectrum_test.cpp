// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/analysis/noise/made_noise.h"

namespace navcal::analysis {
namespace {

constexpr double kSpectrumPeriod_s = 0.02;

TEST(NoiseSpectrum, OfWhiteNoiseIsTwiceTheVarianceOverTheRate) {
  const auto spectrum = spectrum_of({noise_test::MadeNoise(1).white(50000, 3)}, kSpectrumPeriod_s);
  ASSERT_FALSE(spectrum.density.empty());
  EXPECT_NEAR(spectrum.frequency_Hz.back(), 25, 2 * spectrum.step_Hz);
  const double mean = std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.0) /
                      static_cast<double>(spectrum.density.size());
  EXPECT_NEAR(mean, 2 * 9 * kSpectrumPeriod_s, 0.02 * 2 * 9 * kSpectrumPeriod_s);
}

TEST(NoiseSpectrum, WhiteNoiseHasLinesByChanceOnly) {
  int recordings = 0;
  for (unsigned seed = 0; seed < 300; ++seed)
    recordings +=
        lines_of(spectrum_of({noise_test::MadeNoise(seed).white(4000, 1)}, kSpectrumPeriod_s)).empty() ? 0 : 1;
  EXPECT_LE(recordings, 5);
}

TEST(NoiseSpectrum, ADriftOrAFilterIsNoLine) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    noise_test::MadeNoise noise(seed);
    EXPECT_TRUE(lines_of(spectrum_of({noise.walk(8000, 1)}, kSpectrumPeriod_s)).empty()) << seed;
    EXPECT_TRUE(lines_of(spectrum_of({noise.filtered(8000, 1, 0.9)}, kSpectrumPeriod_s)).empty()) << seed;
  }
}

TEST(NoiseSpectrum, AVibrationIsALineWithFrequencyAndAmplitude) {
  for (const double frequency_Hz : {3.0, 12.0, 12.345, 24.0}) {
    noise_test::MadeNoise noise(2);
    const auto readings =
        noise_test::sum(noise.white(10000, 0.1), noise_test::sine(10000, 0.05, frequency_Hz * kSpectrumPeriod_s));
    const auto lines = lines_of(spectrum_of({readings}, kSpectrumPeriod_s));
    ASSERT_EQ(lines.size(), 1U) << frequency_Hz;
    EXPECT_NEAR(lines[0].frequency_Hz, frequency_Hz, 0.02);
    EXPECT_NEAR(lines[0].amplitude, 0.05, 0.005);
  }
}

TEST(NoiseSpectrum, SegmentsDoNotReachOverGaps) {
  noise_test::MadeNoise noise(3);
  auto first = noise.white(3000, 1), second = noise.white(3000, 1);
  for (double& value : second) value += 1e6;
  const auto spectrum = spectrum_of({first, second}, kSpectrumPeriod_s);
  EXPECT_LT(*std::max_element(spectrum.density.begin(), spectrum.density.end()), 1);
}

TEST(NoiseSpectrum, NothingFromShortPieces) {
  EXPECT_TRUE(spectrum_of({}, 1).density.empty());
  EXPECT_TRUE(spectrum_of({{1, 2, 3}}, 1).density.empty());
  EXPECT_TRUE(lines_of({}).empty());
}

}  // namespace
}  // namespace navcal::analysis
