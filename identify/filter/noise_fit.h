// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "identify/filter/filtered_replay.h"

namespace navcal::identify {

/// A filter with a pass of it.
struct FollowedRecording {
  const FilteredReplay* filter;
  const FilterPass* pass;
};

struct NoiseFit {
  FilterNoises noises;
  double cost = 0;  ///< twice the negative log posterior of the noises but for a constant
};

/// Disturbances and noises of instruments that several recordings of a vehicle share, by maximum a posteriori with
/// the derivatives of the passes held: no call of the model. The logarithms of all sizes are normal about those of
/// FilterNoises' defaults, with a factor of e^2 (disturbances) or e (noise of readings) as a standard deviation.
/// tau is that of `start`.
///
/// Fisher scoring (Harvey 1989, Forecasting, Structural Time Series Models and the Kalman Filter, section 3.4.5).
[[nodiscard]] NoiseFit fit_noises(std::span<const FollowedRecording> recordings, const FilterNoises& start,
                                  unsigned threads = 2);

/// The best of tau = 1, 3, 10, 30 s; a shorter one where it is less than `kWorthLonger` behind.
[[nodiscard]] NoiseFit fit_noises_and_tau(std::span<const FollowedRecording> recordings, const FilterNoises& start,
                                          unsigned threads = 2);

}  // namespace navcal::identify
