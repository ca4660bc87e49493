// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/channel_noise.h"

#include <algorithm>
#include <cmath>

#include "analysis/noise/series.h"

namespace navcal::analysis {
namespace {

/// Rounding adds resolution^2/12 to the variance of noise of half a step or more (Widrow, Kollar and Liu, 1996).
constexpr double kLeastSteps = 0.5;
/// Times shorter than so many time constants of a filter do not show the white noise behind it.
constexpr double kFilterTimes = 10;

bool all_equal(const Pieces& pieces) {
  for (const auto& piece : pieces) {
    for (const double value : piece) {
      if (value != pieces.front().front()) return false;
    }
  }
  return true;
}

double scatter_about(const Pieces& pieces, double mean) {
  double squares = 0;
  for (const auto& piece : pieces) {
    for (const double value : piece) squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / static_cast<double>(reading_count(pieces) - 1));
}

void separate_rounding(ChannelNoise& noise) {
  if (!noise.reading || noise.reading->drifts) return;
  const double std = noise.reading->std, error = noise.reading->std_error;
  if (!noise.resolution) {
    noise.unrounded = std;
    noise.unrounded_error = error;
    return;
  }
  const double square = std * std - *noise.rounding * *noise.rounding;
  const double least = kLeastSteps * *noise.resolution;
  if (square < least * least) return;
  noise.unrounded = std::sqrt(square);
  noise.unrounded_error = error * std / *noise.unrounded;
}

void find_terms(ChannelNoise& noise, const Pieces& pieces, double period_s) {
  noise.allan = allan_deviation(pieces, period_s);
  double shortest_s = period_s, lag1 = 0;
  if (noise.reading && noise.reading->correlated) {
    // A correlation that is no filter's has no model.
    if (noise.reading->time_constant_s) lag1 = noise.reading->lag1;
    shortest_s = kFilterTimes * std::max(noise.reading->time_constant_s.value_or(0), period_s);
  }
  noise.terms = fit_allan(noise.allan, pieces, period_s, shortest_s, lag1, noise.lines);
  const NoiseTerm& white = noise.terms.white;
  if (!noise.reading || !noise.reading->correlated || !white.value) return;
  noise.effective = *white.value / std::sqrt(period_s);
  noise.effective_error = *white.error / std::sqrt(period_s);
}

}  // namespace

std::optional<double> ChannelNoise::to_reckon() const { return effective ? effective : unrounded; }

double ChannelNoise::to_reckon_error() const {
  return (effective ? effective_error : unrounded_error).value_or(0);
}

ChannelNoise channel_noise(const Series& series, const std::vector<Interval>& intervals) {
  ChannelNoise noise;
  const double median_s = median_period_s(series);
  const double period_s = mean_period_s(series, intervals, median_s);
  const Pieces pieces = pieces_of(series, intervals, median_s);
  noise.resolution = resolution_of(series.values);
  if (noise.resolution) noise.rounding = *noise.resolution / std::sqrt(12.0);
  noise.readings = reading_count(pieces);
  noise.stretches = pieces.size();
  if (pieces.empty() || !(period_s > 0)) return noise;
  noise.rate_Hz = 1 / period_s;
  noise.seconds = static_cast<double>(noise.readings) * period_s;
  noise.mean = mean_of(pieces);
  noise.scatter = scatter_about(pieces, noise.mean);
  noise.constant = all_equal(pieces);
  if (noise.constant) return noise;
  noise.spectrum = spectrum_of(pieces, period_s);
  noise.lines = lines_of(noise.spectrum);
  noise.reading = reading_noise(pieces, period_s, noise.lines);
  separate_rounding(noise);
  find_terms(noise, pieces, period_s);
  return noise;
}

}  // namespace navcal::analysis
