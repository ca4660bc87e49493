// SPDX-License-Identifier: Apache-2.0
#include "instruments/delay_spread.h"

#include <algorithm>
#include <cstddef>

namespace navcal::instruments {
namespace {

constexpr double kPriorWeight = 0.5;  // blocks
constexpr double kMemory = 30;        // blocks
constexpr double kShapeMemory = 60;   // blocks
constexpr double kShapePrior = 3;     // blocks of exponential delays, before anything is known
// (second highest - median) / (median - second lowest) in blocks of 16 exponential delays. For symmetric delays
// it is 1.
constexpr double kExponentialRatio = 2.78;
constexpr double kSharpRatio = 1.8;  // above, the lower edge is taken for sharp
constexpr double kSoftRatio = 1.3;   // below, the residuals are taken for symmetric
constexpr double kCrowded =
    0.35;  // of the mean by the median: so small a mean by the lowest is a crowd at the edge
constexpr std::size_t kLowest = 4;

/// Expected (i-th - lowest) of n exponential delays of mean 1, i from 1.
double above_lowest(std::size_t i, std::size_t n) {
  double sum = 0;
  for (std::size_t j = 1; j < i; ++j) sum += 1.0 / static_cast<double>(n - j);
  return sum;
}

}  // namespace

void DelaySpread::begin(double mean_s, double range_s, double blocks) {
  *this = {};
  mean_s_ = by_median_s_ = by_lowest_s_ = mean_s;
  range_s_ = range_s;
  weight_ = blocks;
}

void DelaySpread::learn(std::span<double> residuals_s) {
  const std::size_t n = residuals_s.size();
  std::sort(residuals_s.begin(), residuals_s.end());
  const double earliest_s = residuals_s.front();
  if (weight_ <= 0) weight_ = kPriorWeight;
  weight_ = std::min(weight_ + 1, kMemory);
  const std::size_t middle = (n + 1) / 2;
  const double middle_s = residuals_s[middle - 1] - earliest_s;
  by_median_s_ += (middle_s / above_lowest(middle, n) - by_median_s_) / weight_;
  by_lowest_s_ += ((residuals_s[kLowest - 1] - earliest_s) / above_lowest(kLowest, n) - by_lowest_s_) / weight_;
  // Frames in bursts: the last frames of the bursts lie at the lower edge, and the others contain no
  // information about it.
  const bool crowded = by_lowest_s_ < kCrowded * by_median_s_;
  mean_s_ = crowded ? by_lowest_s_ : by_median_s_;

  shape_weight_ = std::min(shape_weight_ + 1, kShapeMemory);
  const auto learn_one = [&](double& mean, double value) { mean += (value - mean) / shape_weight_; };
  learn_one(below_s_, residuals_s[middle - 1] - residuals_s[1]);
  learn_one(above_s_, residuals_s[n - 2] - residuals_s[middle - 1]);
  learn_one(middle_s_, middle_s);
  learn_one(range_s_, residuals_s.back() - earliest_s);
  const double below_s = (shape_weight_ + kShapePrior) * below_s_;
  const double above_s = shape_weight_ * above_s_ + kShapePrior * kExponentialRatio * below_s_;
  soft_edge_s_ = 0;
  if (!crowded && below_s > 0) {
    const double softness = (kSharpRatio - above_s / below_s) / (kSharpRatio - kSoftRatio);
    soft_edge_s_ = std::clamp(softness, 0.0, 1.0) * middle_s_;
  }
}

}  // namespace navcal::instruments
