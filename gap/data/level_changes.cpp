// SPDX-License-Identifier: Apache-2.0
#include "gap/data/level_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace navcal::gap {
namespace {

/// Longer series are looked through in steps, so that the number of stretches stays bounded.
constexpr std::size_t kMostPlaces = 400;

/// Sums of a series, for means and scatter of any part at once.
class Sums {
 public:
  explicit Sums(const std::vector<double>& values) : sum_(values.size() + 1, 0), square_(values.size() + 1, 0) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum_[i + 1] = sum_[i] + values[i];
      square_[i + 1] = square_[i] + values[i] * values[i];
    }
  }
  [[nodiscard]] double sum(std::size_t from, std::size_t until) const { return sum_[until] - sum_[from]; }
  [[nodiscard]] double square(std::size_t from, std::size_t until) const { return square_[until] - square_[from]; }

 private:
  std::vector<double> sum_, square_;
};

struct Stretch {
  std::size_t from = 0, until = 0;
  double t = 0, difference = 0;
};

/// Difference between the mean of a stretch and that of the rest of a segment, with its t statistic.
Stretch compared(const Sums& sums, std::size_t begin, std::size_t end, std::size_t from, std::size_t until) {
  const double inside = static_cast<double>(until - from), outside = static_cast<double>(end - begin) - inside;
  const double sum_in = sums.sum(from, until), sum_out = sums.sum(begin, end) - sum_in;
  const double left = sums.square(begin, end) - sum_in * sum_in / inside - sum_out * sum_out / outside;
  const double scatter = std::sqrt(std::max(left, 0.0) / std::max(inside + outside - 2, 1.0));
  const double error = scatter * std::sqrt(1 / inside + 1 / outside);
  const double difference = sum_in / inside - sum_out / outside;
  return {from, until, error > 0 ? std::abs(difference) / error : 0, std::abs(difference)};
}

}  // namespace

std::vector<std::size_t> LevelChanges::of(const std::vector<double>& means) const {
  const Sums sums(means);
  std::vector<std::size_t> found;
  const auto best_in = [&](std::size_t begin, std::size_t end) {
    std::optional<Stretch> best;
    const std::size_t step = (end - begin) / kMostPlaces + 1;
    const auto consider = [&](std::size_t from, std::size_t until) {
      const Stretch stretch = compared(sums, begin, end, from, until);
      const bool counts = stretch.t > clear && stretch.difference > least_difference;
      if (counts && (!best || stretch.t > best->t)) best = stretch;
    };
    for (std::size_t split = begin + least_pieces; split + least_pieces <= end; split += step)
      consider(split, end);
    for (std::size_t from = begin + least_stretch; from + 2 * least_stretch <= end; from += step) {
      for (std::size_t until = from + least_stretch; until + least_stretch <= end; until += step)
        consider(from, until);
    }
    return best;
  };
  const auto cut = [&](const auto& self, std::size_t begin, std::size_t end) -> void {
    if (end - begin < 2 * least_stretch) return;
    const auto best = best_in(begin, end);
    if (!best) return;
    self(self, begin, best->from);
    found.push_back(best->from);
    self(self, best->from, best->until);
    if (best->until == end) return;
    found.push_back(best->until);
    self(self, best->until, end);
  };
  if (!means.empty()) cut(cut, 0, means.size());
  return found;
}

}  // namespace navcal::gap
