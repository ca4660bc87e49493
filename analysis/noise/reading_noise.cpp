// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/reading_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::analysis {
namespace {

constexpr double kLeastPairs = 8;
/// A correlation counts above this value and above so many of its standard errors.
constexpr double kLeastCorrelation = 0.1, kSignificance = 4;
/// A filter's variogram levels off; that of a drift doubles again from two to four readings.
constexpr double kDrift = 0.85;
/// The variogram is taken as level where the correlation is below this.
constexpr double kForgotten = 0.01;

double pairs_at(const Pieces& pieces, std::size_t lag) {
  double pairs = 0;
  for (const auto& piece : pieces) pairs += static_cast<double>(piece.size() - std::min(lag, piece.size()));
  return pairs;
}

std::size_t longest_of(const Pieces& pieces) {
  std::size_t longest = 1;
  for (const auto& piece : pieces) longest = std::max(longest, piece.size());
  return longest;
}

double without_lines(double gamma, std::size_t lag, double period_s, const std::vector<SpectralLine>& lines) {
  for (const SpectralLine& line : lines) {
    const double phase = 2 * std::numbers::pi * line.frequency_Hz * static_cast<double>(lag) * period_s;
    gamma -= line.amplitude * line.amplitude / 2 * (1 - std::cos(phase));
  }
  return std::max(gamma, 0.0);
}

}  // namespace

double variogram(const Pieces& pieces, std::size_t lag) {
  double squares = 0;
  for (const auto& piece : pieces) {
    for (std::size_t i = lag; i < piece.size(); ++i)
      squares += (piece[i] - piece[i - lag]) * (piece[i] - piece[i - lag]);
  }
  const double pairs = pairs_at(pieces, lag);
  return pairs > 0 ? squares / (2 * pairs) : 0;
}

std::optional<ReadingNoise> reading_noise(const Pieces& pieces, double period_s,
                                          const std::vector<SpectralLine>& lines) {
  if (pairs_at(pieces, 4) < kLeastPairs) return std::nullopt;
  const auto gamma = [&](std::size_t lag) { return without_lines(variogram(pieces, lag), lag, period_s, lines); };
  const double one = gamma(1), two = gamma(2), four = gamma(4);
  if (!(one > 0)) return std::nullopt;
  ReadingNoise noise;
  const double readings = static_cast<double>(reading_count(pieces));
  noise.lag1 = std::clamp(two / one - 1, -1.0, 1.0);
  const bool significant = std::abs(noise.lag1) > kSignificance * std::sqrt(2 / readings);
  noise.drifts = significant && noise.lag1 > kDrift && four / two - 1 > kDrift * kDrift;
  noise.correlated = significant && !noise.drifts && std::abs(noise.lag1) > kLeastCorrelation;
  std::size_t level_lag = 1;
  if (noise.correlated && noise.lag1 >= 1) {
    level_lag = longest_of(pieces);  // it does not level off within the readings
  } else if (noise.correlated && noise.lag1 > 0) {
    const double level = std::ceil(std::log(kForgotten) / std::log(noise.lag1));
    level_lag = static_cast<std::size_t>(std::min(level, static_cast<double>(longest_of(pieces))));
    noise.time_constant_s = -period_s / std::log(noise.lag1);
  } else if (noise.correlated) {
    level_lag = 2;
  }
  while (level_lag > 1 && pairs_at(pieces, level_lag) < kLeastPairs) --level_lag;
  noise.std = std::sqrt(gamma(level_lag));
  const double a = noise.correlated ? std::abs(noise.lag1) : 0;
  // The variance of gamma(1) of white noise is 3 s^4 / n: two thirds of a degree of freedom for each reading.
  const double freedom = 2 * readings / 3 * (1 - a * a) / (1 + a * a);
  noise.std_error = noise.std / std::sqrt(2 * std::max(freedom, 1.0));
  return noise;
}

}  // namespace navcal::analysis
