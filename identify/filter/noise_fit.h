// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

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
/// tau is that of `start`. A disturbance is not below 1 % of the acceleration that the actuators cause in its
/// axis, and the noise of a channel that always reads the same is that of `start`.
///
/// Fisher scoring (Harvey 1989, Forecasting, Structural Time Series Models and the Kalman Filter, section 3.4.5).
[[nodiscard]] NoiseFit fit_noises(std::span<const FollowedRecording> recordings, const FilterNoises& start,
                                  unsigned threads = 2);

/// The best of tau = 1, 3, 10, 30 s; a shorter one where it is less than `kWorthLonger` behind.
[[nodiscard]] NoiseFit fit_noises_and_tau(std::span<const FollowedRecording> recordings, const FilterNoises& start,
                                          unsigned threads = 2);

/// Mean correlation of neighbouring innovations of the recording where it is least, with these noises, over the
/// channels whose readings vary. About 0 at the vehicle's own numbers, and larger where readings were filtered,
/// averaged or interpolated before they were recorded.
[[nodiscard]] double least_correlation(std::span<const FollowedRecording> recordings, const FilterNoises& noises);

/// From this correlation on readings are not independent: -0.04 where they are, 0.33 of a ship model's, which were
/// means. The intervals of thinned readings that are tried in turn then, s.
inline constexpr double kDependent = 0.2;
inline constexpr std::array kIntervals_s{0.0, 0.3, 1.0, 3.0};
/// For users whose readings are used at such an interval.
[[nodiscard]] std::string thinned_warning(double interval_s);

}  // namespace navcal::identify
