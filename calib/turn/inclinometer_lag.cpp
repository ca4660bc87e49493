// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/inclinometer_lag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::calib {
namespace {

constexpr double kSteepest_rad = 1.2;  // beyond it the slopes of roll and pitch lose their meaning
constexpr double kCompare_s = 0.4;     // longer than the lag, so that noise of the tilt counts little
constexpr double kBiasSpan_s = 300;    // a bias drifts: after so long the older readings count less
constexpr std::uint32_t kCompared = 12;
/// The readings decide where one explanation leaves less than this share of what the other leaves.
constexpr double kClearlyLess = 0.8;

/// Roll has no beginning.
Eigen::Vector2d difference(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {std::remainder(a.x() - b.x(), 2 * std::numbers::pi), a.y() - b.y()};
}

}  // namespace

void InclinometerLag::begin_segment() {
  points_ = 0;
  bias_rad_s_ = bias_now_rad_s_;
  bias_anchor_.set = compare_anchor_.set = false;
}

void InclinometerLag::update(double time_s, const Eigen::Vector3d& rate_rad_s) {
  const double sine = std::sin(shown_rad_.x()), cosine = std::cos(shown_rad_.x());
  const double pitch_rad = std::clamp(shown_rad_.y(), -kSteepest_rad, kSteepest_rad);
  const Eigen::Vector2d slope(
      rate_rad_s.x() + (rate_rad_s.y() * sine + rate_rad_s.z() * cosine) * std::tan(pitch_rad),
      rate_rad_s.y() * cosine - rate_rad_s.z() * sine);
  const double since_s = points_ > 0 ? time_s - point(0).time_s : 0;
  if (points_ > 0 && since_s <= 0) return;
  Point next;
  next.time_s = time_s;
  if (points_ > 0) {
    const Point& last = point(0);
    const Eigen::Vector2d mean = (slope_rad_s_ + slope) / 2;
    const double share = -std::expm1(-since_s / lag_s_);
    next.slope_rad_s = last.slope_rad_s + share * (mean - last.slope_rad_s);
    // Exact for a constant input: the integral of the lag's answer is that of its input less L times its change.
    next.lagged_rad = last.lagged_rad + since_s * mean - lag_s_ * (next.slope_rad_s - last.slope_rad_s);
    next.direct_rad = last.direct_rad + since_s * mean;
  }
  slope_rad_s_ = slope;
  newest_ = (newest_ + 1) % kPoints;
  points_ = std::min(points_ + 1, kPoints);
  ring_[newest_] = next;
}

void InclinometerLag::update(double time_s, const Eigen::Vector2d& shown_rad) {
  shown_rad_ = shown_rad;
  Point at;
  if (!find(time_s, at)) return;
  const Anchor now{true, time_s, shown_rad, at.lagged_rad, at.direct_rad};
  learn_bias(now);
  compare(now);
}

bool InclinometerLag::find(double time_s, Point& at) const {
  std::uint32_t back = 0;
  while (back + 1 < points_ && point(back + 1).time_s > time_s) ++back;
  if (back + 1 >= points_ || point(back).time_s < time_s) return false;
  const Point &after = point(back), &before = point(back + 1);
  const double share = (time_s - before.time_s) / (after.time_s - before.time_s);
  at.time_s = time_s;
  at.slope_rad_s = before.slope_rad_s + share * (after.slope_rad_s - before.slope_rad_s);
  at.lagged_rad = before.lagged_rad + share * (after.lagged_rad - before.lagged_rad);
  at.direct_rad = before.direct_rad + share * (after.direct_rad - before.direct_rad);
  return true;
}

void InclinometerLag::learn_bias(const Anchor& now) {
  if (!bias_anchor_.set) {
    bias_anchor_ = now;
    return;
  }
  const double span_s = now.time_s - bias_anchor_.time_s;
  const Eigen::Vector2d drift =
      now.lagged_rad - bias_anchor_.lagged_rad - difference(now.shown_rad, bias_anchor_.shown_rad);
  bias_now_rad_s_ = (drift + bias_weight_s_ * bias_rad_s_) / (span_s + bias_weight_s_);
  if (span_s < kBiasSpan_s) return;
  bias_rad_s_ = bias_now_rad_s_;
  bias_weight_s_ = kBiasSpan_s / 3;
  bias_anchor_.set = false;
}

void InclinometerLag::compare(const Anchor& now) {
  const double span_s = now.time_s - compare_anchor_.time_s;
  if (compare_anchor_.set && span_s < kCompare_s) return;
  if (compare_anchor_.set && span_s < 3 * kCompare_s) {
    const Eigen::Vector2d change = difference(now.shown_rad, compare_anchor_.shown_rad);
    const Eigen::Vector2d by_rates = change + span_s * bias_now_rad_s_;
    still_square_ += change.squaredNorm();
    lagged_square_ += (by_rates - now.lagged_rad + compare_anchor_.lagged_rad).squaredNorm();
    direct_square_ += (by_rates - now.direct_rad + compare_anchor_.direct_rad).squaredNorm();
    ++compared_;
    decide();
  }
  compare_anchor_ = now;
}

void InclinometerLag::decide() {
  if (compared_ < kCompared) return;
  // Where there is more than noise, gyros that tell of the motion explain most of it.
  const bool moves = still_square_ > 4 * still_rad2_ * compared_;
  const bool gyros_tell = !moves || lagged_square_ < kClearlyLess * still_square_;
  lags_ = gyros_tell && direct_square_ >= (lags_ ? kClearlyLess : 1.0) * lagged_square_;
}

void InclinometerLag::archive(Archive& archive) {
  archive.tag("inclinometer_lag 2");
  archive(ring_, newest_, points_, slope_rad_s_, shown_rad_, bias_rad_s_, bias_now_rad_s_, bias_weight_s_);
  archive(bias_anchor_, compare_anchor_, still_square_, lagged_square_, direct_square_, compared_, lags_);
  newest_ %= kPoints;
  points_ = std::min(points_, kPoints);
}

}  // namespace navcal::calib
