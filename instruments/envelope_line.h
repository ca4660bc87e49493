// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace navcal::instruments {

/// A straight line below all observations: time = end_s + slope_s * (index - index of the last one).
///
/// Model: observation i is index[i] * period + phase + delay, with independent exponential delays. The
/// maximum-likelihood line is the edge of the lower convex hull at the mean index. With N observations over K
/// indices and a mean delay d, its errors scale with d / N at the end and with d / (N K) in the slope. The
/// factors come from simulation, for 4 to 32 observations with and without lost ones.
struct EnvelopeLine {
  double end_s = 0;    ///< of the last observation's index, already less the line's mean excess
  double slope_s = 0;  ///< per index
  double delay_s = 0;  ///< mean delay, from the median of the residuals, so that a few stalls do not count
  double end_std_s = 0;
  double slope_std_s = 0;
};

/// Correlation of the errors of end and slope.
inline constexpr double kEndSlopeCorrelation = 0.92;

inline constexpr int kEnvelopeMost = 32;  ///< observations

/// Fits the line. `index` strictly increasing, `time_s` never decreasing, 3 to kEnvelopeMost of them.
[[nodiscard]] EnvelopeLine fit_envelope(std::span<const double> index, std::span<const double> time_s);

}  // namespace navcal::instruments
