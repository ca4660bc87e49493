// SPDX-License-Identifier: Apache-2.0
#include "instruments/envelope_line.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace navcal::instruments {
namespace {

// Factors in units of (mean delay / N), for the slope (mean delay / (N K)); see EnvelopeLine.
constexpr double kEndExcess = 1.8;
constexpr double kEndStd = 3.6;
constexpr double kSlopeStd = 7.0;
constexpr double kMedianOfExponential = 0.693;

/// End points of the hull's edge above `middle`.
struct Edge {
  std::size_t from = 0, to = 0;
};

Edge lower_hull_edge(std::span<const double> index, std::span<const double> time_s, double middle) {
  std::array<std::size_t, kEnvelopeMost> hull{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    while (size >= 2) {
      const std::size_t a = hull[size - 2];
      const std::size_t b = hull[size - 1];
      const double turn =
          (index[b] - index[a]) * (time_s[i] - time_s[a]) - (time_s[b] - time_s[a]) * (index[i] - index[a]);
      if (turn > 0) break;
      --size;
    }
    hull[size++] = i;
  }
  std::size_t j = 0;
  while (j + 2 < size && index[hull[j + 1]] < middle) ++j;
  return {hull[j], hull[j + 1]};
}

}  // namespace

EnvelopeLine fit_envelope(std::span<const double> index, std::span<const double> time_s) {
  const std::size_t n = index.size();
  const auto count = static_cast<double>(n);
  double sum = 0;
  for (const double k : index) sum += k;
  const Edge edge = lower_hull_edge(index, time_s, sum / count);
  EnvelopeLine line;
  line.slope_s = (time_s[edge.to] - time_s[edge.from]) / (index[edge.to] - index[edge.from]);
  line.end_s = time_s[edge.from] + line.slope_s * (index[n - 1] - index[edge.from]);

  std::array<double, kEnvelopeMost> residuals{};
  for (std::size_t i = 0; i < n; ++i)
    residuals[i] = time_s[i] - line.end_s - line.slope_s * (index[i] - index[n - 1]);
  auto* const middle = residuals.data() + n / 2;
  std::nth_element(residuals.data(), middle, residuals.data() + n);
  // Two of the residuals are zero: the line goes through them.
  line.delay_s = std::max(0.0, *middle) / (kMedianOfExponential * (1 - 2 / count));

  const double unit_s = line.delay_s / count;
  line.end_s -= kEndExcess * unit_s;
  line.end_std_s = kEndStd * unit_s;
  line.slope_std_s = kSlopeStd * unit_s / (index[n - 1] - index[0] + 1);
  return line;
}

}  // namespace navcal::instruments
