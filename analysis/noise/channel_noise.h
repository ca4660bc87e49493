// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "analysis/noise/allan_fit.h"
#include "analysis/noise/reading_noise.h"
#include "analysis/noise/spectrum.h"

namespace navcal::analysis {

/// What the readings of one channel at rest show. Values are in the channel's unit.
struct ChannelNoise {
  std::size_t readings = 0, stretches = 0;
  double rate_Hz = 0, seconds = 0;   ///< of the readings used
  double mean = 0, scatter = 0;      ///< scatter: standard deviation of all readings about their mean
  std::optional<double> resolution;  ///< step by which readings are rounded, over the whole recording
  bool constant = false;             ///< all readings are equal: the noise is below the resolution
  /// Noise of one reading, rounding included; nullopt where the readings are too few, equal, or drift.
  std::optional<ReadingNoise> reading;
  /// Standard deviation that rounding adds, resolution / sqrt(12).
  std::optional<double> rounding;
  /// Noise before rounding and its standard error. nullopt where rounding hides it: below half a step, the formula
  /// for rounding no longer holds.
  std::optional<double> unrounded, unrounded_error;
  /// Standard deviation of independent readings with the same average: the white noise times the root of the rate.
  std::optional<double> effective, effective_error;
  AllanFit terms;
  std::vector<AllanPoint> allan;
  Spectrum spectrum;
  std::vector<SpectralLine> lines;

  /// The noise to reckon with, and its error: before rounding, and the effective one where readings are
  /// correlated.
  [[nodiscard]] std::optional<double> to_reckon() const;
  [[nodiscard]] double to_reckon_error() const;
};

/// From the readings within the intervals. Values that are not finite must have been left out.
[[nodiscard]] ChannelNoise channel_noise(const Series& series, const std::vector<Interval>& intervals);

}  // namespace navcal::analysis
