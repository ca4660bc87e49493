// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace navcal::analysis {
namespace {

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
