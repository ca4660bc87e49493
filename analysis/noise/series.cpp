// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/series.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/statistics.h"

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

/// Errors of the numbers themselves, as a share of the largest: of double precision with conversions of units, and
/// of devices that send single precision.
constexpr std::array kNumberErrors{1e-11, 2e-7};
/// A step is at least so many times as large as these errors.
constexpr double kAboveError = 10;
/// The step may be this much smaller than the smallest difference that occurs, not less: else any numbers would
/// have one.
constexpr double kLeastShare = 1e-3;
/// Euclid's algorithm ends at this share of the smallest difference.
constexpr double kEndShare = 1e-4;
/// A value fits the step when it is so near to a multiple, in steps.
constexpr double kFit = 0.02;

double common_divisor(double a, double b, double end) {
  while (b > end) {
    const double rest = std::abs(std::remainder(a, b));
    a = b;
    b = rest;
  }
  return a;
}

/// The step of sorted values whose errors are at most `error`.
std::optional<double> step_of(const std::vector<double>& sorted, double error) {
  std::vector<double> levels{sorted.front()};
  for (const double value : sorted) {
    if (value - levels.back() > error) levels.push_back(value);
  }
  if (levels.size() < 2) return std::nullopt;
  double smallest = levels.back() - levels.front();
  for (std::size_t i = 1; i < levels.size(); ++i) smallest = std::min(smallest, levels[i] - levels[i - 1]);
  const double least = std::max(kAboveError * error, kLeastShare * smallest);
  const double end = std::max(kAboveError * error, kEndShare * smallest);
  double step = smallest;
  for (std::size_t i = 1; i < levels.size() && step >= least; ++i)
    step = common_divisor(levels[i] - levels[i - 1], step, end);
  if (step < least) return std::nullopt;
  // The longest distance gives the step with the smallest error.
  const double length = levels.back() - levels.front();
  step = length / std::round(length / step);
  for (const double level : levels) {
    if (std::abs(std::remainder(level - levels.front(), step)) > kFit * step) return std::nullopt;
  }
  return step;
}

}  // namespace

double median_period_s(const Series& series) {
  if (series.time_s.size() < 2) return 0;
  std::vector<double> steps;
  steps.reserve(series.time_s.size());
  for (std::size_t i = 1; i < series.time_s.size(); ++i) steps.push_back(series.time_s[i] - series.time_s[i - 1]);
  return std::max(base::median(std::move(steps)), 0.0);
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

double quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
  std::nth_element(numbers.begin(), numbers.begin() + place, numbers.end());
  return numbers[static_cast<std::size_t>(place)];
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

std::optional<double> resolution_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double largest = std::max(std::abs(values.front()), std::abs(values.back()));
  for (const double share : kNumberErrors) {
    if (const auto step = step_of(values, share * largest)) return step;
  }
  return std::nullopt;
}

}  // namespace navcal::analysis
