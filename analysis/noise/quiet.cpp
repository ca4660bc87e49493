// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/quiet.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "analysis/noise/series.h"

namespace navcal::analysis {
namespace {

constexpr double kQuietBlock_s = 1;
constexpr std::size_t kBlocks = 8;       // of a window
constexpr std::size_t kLeastBlocks = 6;  // with readings, for a channel to judge a window
constexpr double kLeastInterval_s = 10;
constexpr double kLongestPeriod_s = 1.5;  // of a channel that judges; readings further apart are not neighbours
/// Chance that noise alone exceeds a limit in one window of one channel; and the margin over that limit for noise
/// that is not quite white.
constexpr double kMotionChance = 1e-5, kMargin = 1.5;
/// The factor for a filter counts up to this correlation: slow motion of a precise instrument looks like more.
constexpr double kMostCorrelation = 0.8;
/// Quantile of the windows that gives a channel's own noise: most windows may vibrate.
constexpr double kFloorQuantile = 0.2;

struct QuietBlock {
  double readings = 0, mean = 0;
  double pairs1 = 0, squares1 = 0, pairs2 = 0, squares2 = 0;  ///< of differences one and two readings apart
};

std::vector<QuietBlock> blocks_of(const Series& series, std::size_t count) {
  std::vector<QuietBlock> blocks(count);
  const auto& [time_s, values] = series;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double place = std::floor(time_s[i] / kQuietBlock_s);
    if (place < 0 || place >= static_cast<double>(count)) continue;
    QuietBlock& block = blocks[static_cast<std::size_t>(place)];
    block.mean += (values[i] - block.mean) / ++block.readings;
    if (i >= 1 && time_s[i] - time_s[i - 1] < kLongestPeriod_s) {
      ++block.pairs1;
      block.squares1 += std::pow(values[i] - values[i - 1], 2);
    }
    if (i >= 2 && time_s[i] - time_s[i - 2] < 2 * kLongestPeriod_s) {
      ++block.pairs2;
      block.squares2 += std::pow(values[i] - values[i - 2], 2);
    }
  }
  return blocks;
}

/// Statistics of one channel in one window.
struct QuietWindow {
  bool judged = false;
  double blocks = 0, readings = 0, mean = 0;
  double slow = 0;                           ///< variance of the block means
  double gamma1 = 0, pairs = 0, gamma2 = 0;  ///< variogram
};

QuietWindow window_at(const std::vector<QuietBlock>& blocks, std::size_t first) {
  QuietWindow window;
  double pairs2 = 0;
  for (std::size_t i = first; i < first + kBlocks; ++i) {
    const QuietBlock& block = blocks[i];
    if (block.readings == 0) continue;
    ++window.blocks;
    window.readings += block.readings;
    const double departure = block.mean - window.mean;
    window.mean += departure / window.blocks;
    window.slow += departure * (block.mean - window.mean);
    window.gamma1 += block.squares1;
    window.pairs += block.pairs1;
    window.gamma2 += block.squares2;
    pairs2 += block.pairs2;
  }
  window.judged = window.blocks >= static_cast<double>(kLeastBlocks) && window.pairs >= 4 && pairs2 >= 3;
  if (!window.judged) return window;
  window.slow /= window.blocks - 1;
  window.gamma1 /= 2 * window.pairs;
  window.gamma2 /= 2 * pairs2;
  return window;
}

/// Ratio of the largest to the mean of a chi-squared variable that chance gives.
double largest_by_chance(double freedom) {
  const boost::math::chi_squared distribution(std::max(freedom, 1.0));
  return kMargin * quantile(complement(distribution, kMotionChance)) / std::max(freedom, 1.0);
}

/// A channel's windows with the limits that follow from its own noise.
class Judge {
 public:
  Judge(const MotionChannel& channel, std::size_t block_count) : channel_(channel) {
    const auto blocks = blocks_of(*channel.series, block_count);
    for (std::size_t first = 0; first + kBlocks <= block_count; ++first)
      windows_.push_back(window_at(blocks, first));
    const double step = resolution_of(channel.series->values).value_or(0);
    least_ = std::pow(channel.slow_limit, 2) + step * step;
    std::vector<double> gammas, correlations;
    for (const QuietWindow& window : windows_) {
      if (!window.judged) continue;
      gammas.push_back(window.gamma1);
      if (window.gamma1 > 0) correlations.push_back(window.gamma2 / window.gamma1 - 1);
    }
    own_gamma_ = quantile(gammas, 0.5);
    const double a = std::clamp(quantile(correlations, 0.5), 0.0, kMostCorrelation);
    filter_ = (1 + a) / ((1 - a) * (1 - a));
    std::vector<double> at_rest;
    for (const QuietWindow& window : windows_) {
      if (window.judged && window.slow <= slow_limit(window)) at_rest.push_back(window.gamma1);
    }
    floor_gamma_ = quantile(at_rest, kFloorQuantile);
  }

  /// Squared ratio of the worst quantity to its limit: at most 1 at rest; nullopt: the channel does not judge.
  [[nodiscard]] std::optional<double> against(std::size_t window, QuietestWindow& worst) const {
    const QuietWindow& w = windows_[window];
    if (!w.judged) return std::nullopt;
    double ratio = -1;
    const auto compare = [&](const char* what, double square, double limit) {
      if (square / limit <= ratio) return;
      ratio = square / limit;
      worst = {static_cast<double>(window) * kQuietBlock_s,
               channel_.name,
               channel_.unit,
               what,
               std::sqrt(square),
               std::sqrt(limit)};
    };
    compare("varies by", w.slow, slow_limit(w));
    compare("vibrates by", w.gamma1, fast_limit(w));
    if (channel_.mean_limit) compare("has a mean of", w.mean * w.mean, std::pow(*channel_.mean_limit, 2));
    return ratio;
  }

 private:
  [[nodiscard]] double slow_limit(const QuietWindow& window) const {
    const double gamma = std::min(window.gamma1, 2 * own_gamma_);
    const double expected = std::max(gamma, own_gamma_ / 2) * filter_ * window.blocks / window.readings;
    return std::max(expected * largest_by_chance(window.blocks - 1), least_);
  }
  [[nodiscard]] double fast_limit(const QuietWindow& window) const {
    return kMargin * floor_gamma_ * largest_by_chance(2 * window.pairs / 3) + least_;
  }

  const MotionChannel& channel_;
  std::vector<QuietWindow> windows_;
  double least_ = 0, own_gamma_ = 0, filter_ = 1, floor_gamma_ = 0;
};

/// The windows at rest as intervals. A block beside one in motion is left out: the motion may have begun there.
std::vector<Interval> joined(const std::vector<bool>& at_rest, double duration_s) {
  std::vector<Interval> intervals;
  for (std::size_t first = 0; first < at_rest.size();) {
    if (!at_rest[first]) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < at_rest.size() && at_rest[last + 1]) ++last;
    const bool ends = last + 1 == at_rest.size();
    const double from_s = first == 0 ? 0 : (static_cast<double>(first) + 1) * kQuietBlock_s;
    const double to_s = ends ? duration_s : static_cast<double>(last + kBlocks - 1) * kQuietBlock_s;
    const bool apart = intervals.empty() || from_s > intervals.back().to_s;
    if (apart && to_s - from_s >= kLeastInterval_s) intervals.push_back({from_s, to_s});
    if (!apart) intervals.back().to_s = to_s;
    first = last + 1;
  }
  return intervals;
}

}  // namespace

QuietParts quiet_parts(const std::vector<MotionChannel>& channels, double duration_s) {
  QuietParts parts;
  const auto block_count = static_cast<std::size_t>(std::max(duration_s, 0.0) / kQuietBlock_s);
  if (block_count < kBlocks) return parts;
  std::vector<Judge> judges;
  judges.reserve(channels.size());
  for (const MotionChannel& channel : channels) judges.emplace_back(channel, block_count);
  std::vector<bool> at_rest(block_count - kBlocks + 1, false);
  double least = INFINITY;
  for (std::size_t window = 0; window < at_rest.size(); ++window) {
    double largest = -1;
    QuietestWindow worst;
    for (const Judge& judge : judges) {
      QuietestWindow found;
      const auto ratio = judge.against(window, found);
      if (!ratio || *ratio <= largest) continue;
      largest = *ratio;
      worst = found;
    }
    if (largest < 0) continue;
    at_rest[window] = largest <= 1;
    if (largest >= least) continue;
    least = largest;
    parts.quietest = worst;
  }
  parts.intervals = joined(at_rest, duration_s);
  if (!parts.intervals.empty()) parts.quietest.reset();
  return parts;
}

}  // namespace navcal::analysis
