// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "analysis/noise/series.h"
#include "analysis/noise/spectrum.h"

/// Noise of a single reading and whether consecutive readings are correlated, from half the mean square of
/// differences k readings apart, the variogram gamma(k) = s^2 (1 - r(k)) with r the autocorrelation. Differences
/// do not see the mean, and hardly a slow drift. Spectral lines are taken off: a line of amplitude A and frequency
/// f adds A^2/2 (1 - cos(2 pi f k tau0)).
///
/// Readings behind a first-order filter of lag T are correlated by r(k) = a^k with a = exp(-tau0 / T), thus
/// gamma(2) / gamma(1) = 1 + a. Averages of such readings are noisier than those of independent ones of the same
/// standard deviation, by the square root of (1 + a) / (1 - a).
namespace navcal::analysis {

struct ReadingNoise {
  double std = 0;           ///< of one reading, rounding included, lines excluded
  double std_error = 0;     ///< standard error of `std`
  double lag1 = 0;          ///< estimate of a
  bool correlated = false;  ///< `lag1` is significant and above a tenth; not a drift
  bool drifts = false;      ///< differences grow with their distance: no noise of a single reading can be told
  std::optional<double> time_constant_s;  ///< T, if the readings are positively correlated
};

/// nullopt for fewer than 8 readings that have a fifth one after them, and for readings that are all equal.
[[nodiscard]] std::optional<ReadingNoise> reading_noise(const Pieces& pieces, double period_s,
                                                        const std::vector<SpectralLine>& lines);

/// Half the mean square of differences `lag` readings apart. 0 without such readings.
[[nodiscard]] double variogram(const Pieces& pieces, std::size_t lag);

}  // namespace navcal::analysis
