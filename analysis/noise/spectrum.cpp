// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/spectrum.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "base/statistics.h"

namespace navcal::analysis {
namespace {

constexpr std::size_t kShortest = 64, kLongest = 8192;  // segments, readings
/// Segments that the readings should give at least: the spread of a density is then a quarter of it.
constexpr std::size_t kSegments = 16;
/// Degrees of freedom of a segment where Hann windows overlap by half (Welch's equation for the variance).
constexpr double kFreedom = 2 / (1 + 2.0 / 36);

constexpr double kLineChance = 1e-3;         // of a line by chance in a whole spectrum
constexpr std::size_t kMainLobe = 2;         // half width of a line under a Hann window, values
constexpr std::size_t kNeighbours = 16;      // values of the background, each side
constexpr std::size_t kLeastNeighbours = 4;  // fewer do not make a median
constexpr std::size_t kMostLines = 10;

std::size_t segment_length(const Pieces& pieces) {
  std::size_t longest = 0;
  for (const auto& piece : pieces) longest = std::max(longest, piece.size());
  std::size_t length = kLongest;
  const auto covered = [&] {
    std::size_t readings = 0;
    for (const auto& piece : pieces) readings += piece.size() >= length ? piece.size() : 0;
    return readings;
  };
  while (length > kShortest && (length > longest || covered() < length * kSegments / 2)) length /= 2;
  return length <= longest ? length : 0;
}

/// Takes a straight line off, by least squares, and applies the window.
void prepare(std::vector<double>& segment, const std::vector<double>& window) {
  const double n = static_cast<double>(segment.size()), middle = (n - 1) / 2;
  double mean = 0, slope = 0;
  for (std::size_t i = 0; i < segment.size(); ++i) {
    mean += segment[i] / n;
    slope += (static_cast<double>(i) - middle) * segment[i];
  }
  slope /= n * (n * n - 1) / 12;
  for (std::size_t i = 0; i < segment.size(); ++i)
    segment[i] = (segment[i] - mean - slope * (static_cast<double>(i) - middle)) * window[i];
}

/// Level of the neighbourhood without the line itself; 0 where there are too few neighbours.
double background(const std::vector<double>& density, std::size_t at) {
  const std::size_t apart = kMainLobe + 1;
  std::vector<double> below, above;
  for (std::size_t k = apart; k < apart + kNeighbours; ++k) {
    if (at >= k) below.push_back(density[at - k]);
    if (at + k < density.size()) above.push_back(density[at + k]);
  }
  if (below.size() < kLeastNeighbours) return 0;
  const double level = base::median(below);
  return above.size() < kLeastNeighbours ? level : std::max(level, base::median(above));
}

bool is_peak(const std::vector<double>& density, std::size_t at) {
  for (std::size_t k = at - kMainLobe; k <= std::min(at + kMainLobe, density.size() - 1); ++k) {
    if (density[k] > density[at]) return false;
  }
  return true;
}

SpectralLine line_at(const Spectrum& spectrum, std::size_t at, double level) {
  double power = 0, moment = 0;
  for (std::size_t k = at - kMainLobe; k <= std::min(at + kMainLobe, spectrum.density.size() - 1); ++k) {
    const double excess = std::max(spectrum.density[k] - level, 0.0) * spectrum.step_Hz;
    power += excess;
    moment += excess * spectrum.frequency_Hz[k];
  }
  return {moment / power, std::sqrt(2 * power)};
}

}  // namespace

Spectrum spectrum_of(const Pieces& pieces, double period_s) {
  Spectrum spectrum;
  const std::size_t length = segment_length(pieces);
  if (length == 0 || !(period_s > 0)) return spectrum;
  std::vector<double> window(length);
  double weight = 0;
  for (std::size_t i = 0; i < length; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length));
    weight += window[i] * window[i];
  }
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> transform;
  spectrum.density.assign(length / 2 - 1, 0);
  for (const auto& piece : pieces) {
    for (std::size_t first = 0; first + length <= piece.size(); first += length / 2) {
      const auto begin = piece.begin() + static_cast<std::ptrdiff_t>(first);
      std::vector<double> segment(begin, begin + static_cast<std::ptrdiff_t>(length));
      prepare(segment, window);
      fft.fwd(transform, segment);
      for (std::size_t k = 0; k < spectrum.density.size(); ++k)
        spectrum.density[k] += 2 * std::norm(transform[k + 1]) * period_s / weight;
      ++spectrum.segments;
    }
  }
  spectrum.step_Hz = 1 / (period_s * static_cast<double>(length));
  spectrum.degrees_of_freedom = kFreedom * spectrum.segments;
  for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
    spectrum.density[k] /= spectrum.segments;
    spectrum.frequency_Hz.push_back(static_cast<double>(k + 1) * spectrum.step_Hz);
  }
  return spectrum;
}

std::vector<SpectralLine> lines_of(const Spectrum& spectrum) {
  std::vector<SpectralLine> lines;
  const auto& density = spectrum.density;
  if (density.empty()) return lines;
  const boost::math::chi_squared distribution(spectrum.degrees_of_freedom);
  const double threshold =
      quantile(complement(distribution, kLineChance / static_cast<double>(density.size()))) / median(distribution);
  for (std::size_t at = kMainLobe + kLeastNeighbours; at < density.size(); ++at) {
    const double level = background(density, at);
    if (level > 0 && density[at] > threshold * level && is_peak(density, at))
      lines.push_back(line_at(spectrum, at, level));
  }
  std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  if (lines.size() > kMostLines) lines.resize(kMostLines);
  return lines;
}

}  // namespace navcal::analysis
