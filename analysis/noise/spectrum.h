// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/noise/series.h"

/// Welch's estimate of the spectrum (IEEE Trans. Audio and Electroacoustics 15, 1967): segments of equal length
/// with half overlap, straight line removed, Hann window. No segment reaches over a gap.
namespace navcal::analysis {

struct Spectrum {
  std::vector<double> frequency_Hz;  ///< without 0 and without half the rate
  std::vector<double> density;       ///< one-sided power density, unit^2/Hz; white noise has 2 std^2 / rate
  double step_Hz = 0;                ///< between frequencies
  double segments = 0;
  double degrees_of_freedom = 0;  ///< of each value, as a chi-squared variable
};

/// A spectral line, such as a vibration: amplitude sin(2 pi frequency t).
struct SpectralLine {
  double frequency_Hz = 0;
  double amplitude = 0;  ///< unit of the readings
};

/// Empty when no piece has 64 readings.
[[nodiscard]] Spectrum spectrum_of(const Pieces& pieces, double period_s);

/// Peaks above the background of their neighbourhood: in one of a thousand spectra of white noise one is found by
/// chance. The background is the median of neighbouring values, of the side where it is larger, so that a slope is
/// no line. Strongest first, at most ten.
[[nodiscard]] std::vector<SpectralLine> lines_of(const Spectrum& spectrum);

}  // namespace navcal::analysis
