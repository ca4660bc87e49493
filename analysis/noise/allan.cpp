// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/allan.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace navcal::analysis {
namespace {

constexpr double kTail = 0.025;  // of each side of the 95 % interval

/// Sums of the readings before each, and of all: one more than readings. The mean is subtracted, which does not
/// change the Allan variance, so that sums stay small.
std::vector<double> sums_of(const std::vector<double>& readings, double mean) {
  std::vector<double> sums{0};
  sums.reserve(readings.size() + 1);
  for (const double reading : readings) sums.push_back(sums.back() + (reading - mean));
  return sums;
}

}  // namespace

double allan_edf(NoiseKind kind, std::size_t readings, std::size_t factor) {
  if (factor == 0 || readings < 2 * factor) return 0;
  const double n = static_cast<double>(readings) + 1, m = static_cast<double>(factor);  // n sums
  double edf = 1;
  switch (kind) {
    case NoiseKind::white: edf = (3 * (n - 1) / (2 * m) - 2 * (n - 2) / n) * 4 * m * m / (4 * m * m + 5); break;
    case NoiseKind::flicker:
      edf = factor == 1 ? 2 * (n - 2) * (n - 2) / (2.3 * n - 4.9) : 5 * n * n / (4 * m * (n + 3 * m));
      break;
    case NoiseKind::random_walk:
      if (readings > 2)
        edf = (n - 2) / m * ((n - 1) * (n - 1) - 3 * m * (n - 1) + 4 * m * m) / ((n - 3) * (n - 3));
      break;
  }
  return std::max(edf, 1.0);
}

double allan_edf(NoiseKind kind, const Pieces& pieces, std::size_t factor) {
  double edf = 0;
  for (const auto& piece : pieces) edf += allan_edf(kind, piece.size(), factor);
  return edf;
}

void set_confidence(AllanPoint& point, double edf) {
  point.edf = edf;
  const boost::math::chi_squared distribution(edf);
  point.low = point.deviation * std::sqrt(edf / quantile(complement(distribution, kTail)));
  point.high = point.deviation * std::sqrt(edf / quantile(distribution, kTail));
}

std::vector<AllanPoint> allan_deviation(const Pieces& pieces, double period_s) {
  if (!(period_s > 0)) return {};
  std::size_t longest = 0;
  std::vector<std::vector<double>> sums;
  for (const auto& piece : pieces) {
    longest = std::max(longest, piece.size());
    sums.push_back(sums_of(piece, mean_of({piece})));
  }
  std::vector<AllanPoint> points;
  for (std::size_t m = 1; 2 * m <= longest; m *= 2) {
    double squares = 0, places = 0;
    for (const auto& x : sums) {
      for (std::size_t i = 0; i + 2 * m < x.size(); ++i) {
        const double difference = x[i + 2 * m] - 2 * x[i + m] + x[i];
        squares += difference * difference;
        ++places;
      }
    }
    const double factor = static_cast<double>(m);
    AllanPoint point;
    point.factor = m;
    point.tau_s = factor * period_s;
    point.deviation = std::sqrt(squares / (2 * factor * factor * places));
    set_confidence(point, allan_edf(NoiseKind::white, pieces, m));
    points.push_back(point);
  }
  return points;
}

}  // namespace navcal::analysis
