// SPDX-License-Identifier: Apache-2.0
#include "instruments/period_finder.h"

#include <algorithm>
#include <cmath>

namespace navcal::instruments {
namespace {

constexpr std::size_t kKeptLeast = 4;  // frames for a line
constexpr double kImpossible = 1e9;    // score
constexpr double kStallDelays = 4;     // mean delays beyond the median: later ones count as much
constexpr double kDelayFloor_s = 1e-6;
constexpr double kPlausibleDelay_s = 25e-3;  // mean delay of a host, or so much of a period for slow instruments:
constexpr double kPlausibleDelay = 0.1;
constexpr double kTooFast = 0.45;        // of the nominal period: a shorter one is a line that babbles
constexpr double kLostMost = 0.5;        // of the ticks
constexpr double kEarlyMargin = 0.25;    // of a period, by which a frame may lie before the tick it is given
constexpr double kLostCost = 2;          // nats, for each tick without a frame
constexpr double kDelayLeast = 1e-3;     // of the period: smaller delays do not make a period more likely
constexpr double kBurstShare = 0.3;      // of the intervals
constexpr double kSpreadIgnored = 0.02;  // of the period: a line that misses by less is good whatever its misses
constexpr double kDelayMost = 0.4;       // of the period: beyond, ticks cannot be distinguished by time
constexpr double kWalk = 1.0;            // roughness below which the residuals wander
constexpr double kPauseLeast_s = 0.5;
constexpr double kPauseIntervals = 8;  // of the median interval
constexpr int kLostTried = 3;          // more or fewer ticks than the median interval suggests

}  // namespace

bool PeriodFit::bursts() const { return burst_share > kBurstShare; }

bool PeriodFit::too_fast(double nominal_s) const { return !found || line.slope_s < kTooFast * nominal_s; }

bool PeriodFit::plausible_delays() const {
  return line.delay_s < std::max(kPlausibleDelay_s, kPlausibleDelay * line.slope_s);
}

bool PeriodFit::periodic(double nominal_s) const {
  if (too_fast(nominal_s)) return false;
  if (lost > kLostMost * (lost + frames)) return false;
  if (spread_s < kSpreadIgnored * line.slope_s) return true;
  return roughness > kWalk && (bursts() || (plausible_delays() && line.delay_s < kDelayMost * line.slope_s));
}

void PeriodFinder::add(std::int64_t observed_ns, int step, bool backlog) {
  if (frames_ == kFrames) {
    std::move(time_s_.begin() + 1, time_s_.end(), time_s_.begin());
    std::move(step_.begin() + 1, step_.end(), step_.begin());
    std::move(backlog_.begin() + 1, backlog_.end(), backlog_.begin());
    --frames_;
  }
  if (frames_ == 0) origin_ns_ = observed_ns;
  const auto i = static_cast<std::size_t>(frames_);
  time_s_[i] = static_cast<double>(observed_ns - origin_ns_) * 1e-9;
  if (i > 0) time_s_[i] = std::max(time_s_[i], time_s_[i - 1]);
  step_[i] = step;
  backlog_[i] = backlog;
  ++frames_;
  drop_before_pause();
}

double PeriodFinder::median_interval() const {
  std::array<double, kFrames> intervals{};
  for (std::size_t i = 1; i < times().size(); ++i) intervals[i - 1] = time_s_[i] - time_s_[i - 1];
  const int count = frames_ - 1;
  auto* const middle = intervals.data() + count / 2;
  std::nth_element(intervals.data(), middle, intervals.data() + count);
  return *middle;
}

/// After a long silence a device has begun anew: the ticks before it do not predict those after it.
void PeriodFinder::drop_before_pause() {
  if (frames_ < 4) return;
  const double limit_s = std::max(kPauseLeast_s, kPauseIntervals * median_interval());
  std::size_t begin = 0;
  for (std::size_t i = 1; i < times().size(); ++i) {
    const bool counted = step_[i] > 1;
    if (!counted && time_s_[i] - time_s_[i - 1] > limit_s) begin = i;
  }
  if (begin == 0) return;
  const auto shift = static_cast<std::ptrdiff_t>(begin);
  std::move(time_s_.begin() + shift, time_s_.end(), time_s_.begin());
  std::move(step_.begin() + shift, step_.end(), step_.begin());
  std::move(backlog_.begin() + shift, backlog_.end(), backlog_.begin());
  frames_ -= static_cast<int>(begin);
}

void PeriodFinder::count_ticks(Ticks& ticks) const {
  for (std::size_t i = 1; i < times().size(); ++i) ticks.index[i] = ticks.index[i - 1] + std::max(1, step_[i]);
  judge(ticks);
}

/// Assigns ticks frame by frame, each against the earliest time that the frames before allow.
void PeriodFinder::guess_ticks(double period_s, Ticks& ticks) const {
  double tick_s = time_s_[0];
  ticks.index[0] = 0;
  for (std::size_t i = 1; i < times().size(); ++i) {
    const double late = (time_s_[i] - tick_s) / period_s - 1;
    const double step = backlog_[i] ? 1 : 1 + std::max(0.0, std::floor(late + kEarlyMargin));
    ticks.index[i] = ticks.index[i - 1] + step;
    tick_s = std::min(time_s_[i], tick_s + step * period_s);
  }
  judge(ticks);
}

/// Assigns ticks again, by the line through all frames: frames after a late one show that it was late and
/// nothing was lost.
void PeriodFinder::settle_ticks(Ticks& ticks) const {
  const std::size_t last = times().size() - 1;
  const EnvelopeLine line = ticks.line;
  if (line.slope_s <= 0) return;
  const double end = ticks.index[last];
  for (std::size_t i = 0; i <= last; ++i)
    ticks.index[i] = end + std::floor((time_s_[i] - line.end_s) / line.slope_s + kEarlyMargin);
  if (backlog_[last] && last > 0) ticks.index[last] = std::min(ticks.index[last], ticks.index[last - 1] + 1);
  for (std::size_t i = last; i-- > 0;) ticks.index[i] = std::min(ticks.index[i], ticks.index[i + 1] - 1);
  judge(ticks);
}

/// Frames that the line is fitted to. A frame with more of the stream behind it in the same read is known to be
/// late and left out.
PeriodFinder::Kept PeriodFinder::kept_frames() const {
  Kept kept;
  for (std::size_t i = 0; i < times().size(); ++i) {
    if (!backlog_[i]) kept.at[kept.count++] = i;
  }
  if (kept.count >= kKeptLeast && 3 * kept.count >= times().size()) return kept;
  for (std::size_t i = 0; i < times().size(); ++i) kept.at[i] = i;
  kept.count = times().size();
  return kept;
}

void PeriodFinder::judge(Ticks& ticks) const {
  const std::size_t last = times().size() - 1;
  const double span = ticks.index[last] - ticks.index[0];
  const double lost = span - (frames_ - 1);
  const Kept kept = kept_frames();
  std::array<double, kFrames> index{};
  std::array<double, kFrames> time_s{};
  for (std::size_t i = 0; i < kept.count; ++i) {
    index[i] = ticks.index[kept.at[i]];
    time_s[i] = time_s_[kept.at[i]];
  }
  ticks.line = fit_envelope({index.data(), kept.count}, {time_s.data(), kept.count});
  ticks.line.end_s += ticks.line.slope_s * (ticks.index[last] - index[kept.count - 1]);
  if (ticks.line.slope_s <= 0 || lost > kLostMost * (span + 1)) {
    ticks.score = kImpossible;
    return;
  }
  // The score uses the mean, not the median: a few frames after an uncounted loss must show.
  double late_s = 0;
  for (std::size_t i = 0; i < kept.count; ++i)
    late_s += time_s[i] - ticks.line.end_s - ticks.line.slope_s * (index[i] - ticks.index[last]);
  const double relative = std::max(0.0, late_s / static_cast<double>(kept.count)) / ticks.line.slope_s;
  ticks.score = frames_ * std::log(relative + kDelayLeast) + kLostCost * lost;
}

PeriodFinder::Ticks PeriodFinder::best_ticks() const {
  Ticks best;
  if (step_[static_cast<std::size_t>(frames_ - 1)] > 0) {
    count_ticks(best);
    return best;
  }
  // First hypothesis: each frame is the next tick. It is right where none was lost, and for frames in bursts.
  for (std::size_t i = 0; i < times().size(); ++i) best.index[i] = static_cast<double>(i);
  judge(best);
  const double span_s = time_s_[static_cast<std::size_t>(frames_ - 1)];
  const double median_s = median_interval();
  if (median_s <= 0) return best;
  const int ticks_by_median = static_cast<int>(std::min(1e6, std::round(span_s / median_s)));
  for (int k = std::max(frames_ - 1, ticks_by_median - kLostTried); k <= ticks_by_median + kLostTried; ++k) {
    if (k - (frames_ - 1) > kLostMost * (k + 1)) break;
    Ticks ticks;
    guess_ticks(span_s / k, ticks);
    settle_ticks(ticks);
    if (ticks.score < best.score) best = ticks;
  }
  return best;
}

PeriodFit PeriodFinder::fit() const {
  PeriodFit fit;
  fit.origin_ns = origin_ns_;
  fit.frames = frames_;
  if (frames_ < 3) return fit;
  const Ticks ticks = best_ticks();
  if (ticks.line.slope_s <= 0) return fit;
  fit.found = true;
  fit.line = ticks.line;
  const std::size_t last = times().size() - 1;
  fit.lost = static_cast<int>(ticks.index[last] - ticks.index[0]) - (frames_ - 1);

  describe(ticks, fit);
  return fit;
}

void PeriodFinder::describe(const Ticks& ticks, PeriodFit& fit) const {
  const std::size_t last = times().size() - 1;
  const Kept kept = kept_frames();
  const std::size_t n = kept.count;
  std::array<double, kFrames> residuals{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = kept.at[i];
    residuals[i] = time_s_[k] - fit.line.end_s - fit.line.slope_s * (ticks.index[k] - ticks.index[last]);
  }
  auto sorted = residuals;
  auto* const middle = sorted.data() + n / 2;
  std::nth_element(sorted.data(), middle, sorted.data() + n);
  // Bounded residuals, so that a few stalls do not dominate.
  const double most_s = *middle + kStallDelays * std::max(fit.line.delay_s, kDelayFloor_s);
  double difference_s = 0;
  for (std::size_t i = 0; i < n; ++i) {
    residuals[i] = std::min(residuals[i], most_s);
    fit.spread_s += std::abs(residuals[i] - *middle) / static_cast<double>(n);
    fit.range_s = std::max(fit.range_s, residuals[i]);
    if (i > 0) difference_s += std::abs(residuals[i] - residuals[i - 1]) / static_cast<double>(n - 1);
  }
  fit.roughness = fit.spread_s > 0 ? difference_s / fit.spread_s : 2;
  int shorts = 0;
  for (std::size_t i = 1; i <= last; ++i)
    shorts += time_s_[i] - time_s_[i - 1] < kBurstInterval * fit.line.slope_s ? 1 : 0;
  fit.burst_share = static_cast<double>(shorts) / static_cast<double>(last);
}

}  // namespace navcal::instruments
