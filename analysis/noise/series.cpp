// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/series.h"

#include <algorithm>

namespace navcal::analysis {
namespace {

constexpr double kGapPeriods = 1.6;

/// First and one past the last reading of each stretch without a gap.
struct Run {
  std::size_t first = 0, last = 0;
};

std::vector<Run> runs_of(const Series& series, const std::vector<Interval>& intervals, double period_s) {
  std::vector<Run> runs;
  const auto& time_s = series.time_s;
  for (const Interval& interval : intervals) {
    std::size_t first = 0, next = 0;
    const auto end_run = [&] {
      if (next - first >= 2) runs.push_back({first, next});
      first = next;
    };
    for (; next < time_s.size(); ++next) {
      const bool inside = time_s[next] >= interval.from_s && time_s[next] <= interval.to_s;
      const double step_s = next > first ? time_s[next] - time_s[next - 1] : period_s;
      if (!inside || step_s > kGapPeriods * period_s || step_s <= 0) end_run();
      if (!inside) first = next + 1;
    }
    if (first < next) end_run();
  }
  return runs;
}

}  // namespace

double median_period_s(const Series& series) {
  if (series.time_s.size() < 2) return 0;
  std::vector<double> steps;
  steps.reserve(series.time_s.size());
  for (std::size_t i = 1; i < series.time_s.size(); ++i) steps.push_back(series.time_s[i] - series.time_s[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(*middle, 0.0);
}

Pieces pieces_of(const Series& series, const std::vector<Interval>& intervals, double period_s) {
  Pieces pieces;
  for (const Run& run : runs_of(series, intervals, period_s)) {
    const auto begin = series.values.begin();
    pieces.emplace_back(begin + static_cast<std::ptrdiff_t>(run.first),
                        begin + static_cast<std::ptrdiff_t>(run.last));
  }
  return pieces;
}

double mean_period_s(const Series& series, const std::vector<Interval>& intervals, double period_s) {
  double length_s = 0, steps = 0;
  for (const Run& run : runs_of(series, intervals, period_s)) {
    length_s += series.time_s[run.last - 1] - series.time_s[run.first];
    steps += static_cast<double>(run.last - run.first - 1);
  }
  return steps > 0 ? length_s / steps : 0;
}

std::size_t reading_count(const Pieces& pieces) {
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  return count;
}

double mean_of(const Pieces& pieces) {
  double mean = 0, count = 0;
  for (const auto& piece : pieces) {
    for (const double value : piece) mean += (value - mean) / ++count;
  }
  return mean;
}

}  // namespace navcal::analysis
