// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/bounded.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace navcal::analysis {
namespace {

constexpr std::size_t kFewestMeans = 4;
constexpr double kNormal = 1.96;

/// The 97.5 % point of Student's t, within 1 % from 3 degrees of freedom on.
double student(double freedom) { return kNormal + 2.4 / freedom + 3.5 / (freedom * freedom); }

}  // namespace

Bounded bounded(double value, double std) { return {value, value - kNormal * std, value + kNormal * std}; }

std::optional<Bounded> mean_bounded(const std::vector<double>& numbers) {
  if (numbers.size() < kFewestMeans) return std::nullopt;
  const auto count = static_cast<double>(numbers.size());
  double sum = 0, squares = 0;
  for (const double number : numbers) sum += number;
  const double mean = sum / count;
  for (const double number : numbers) squares += (number - mean) * (number - mean);
  const double half = student(count - 1) * std::sqrt(squares / (count - 1) / count);
  return Bounded{mean, mean - half, mean + half};
}

std::vector<double> block_means(const std::vector<double>& time_s, const std::vector<double>& values,
                                std::size_t least, std::size_t blocks) {
  std::vector<double> means;
  if (time_s.empty()) return means;
  const auto [first, last] = std::minmax_element(time_s.begin(), time_s.end());
  const double length_s = (*last - *first) / static_cast<double>(blocks);
  std::vector<double> sums(blocks);
  std::vector<std::size_t> counts(blocks);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double place = length_s > 0 ? (time_s[i] - *first) / length_s : 0;
    const std::size_t block = std::min(static_cast<std::size_t>(place), blocks - 1);
    sums[block] += values[i];
    ++counts[block];
  }
  for (std::size_t i = 0; i < blocks; ++i) {
    if (counts[i] >= least) means.push_back(sums[i] / static_cast<double>(counts[i]));
  }
  return means;
}

std::optional<Bounded> root_mean_square_bounded(const std::vector<double>& time_s, std::vector<double> values) {
  for (double& value : values) value *= value;
  auto square = mean_bounded(block_means(time_s, values));
  if (!square) return std::nullopt;
  return Bounded{std::sqrt(square->value), std::sqrt(std::max(square->low, 0.0)), std::sqrt(square->high)};
}

}  // namespace navcal::analysis
