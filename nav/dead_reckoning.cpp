// SPDX-License-Identifier: Apache-2.0
#include "nav/dead_reckoning.h"

#include <algorithm>
#include <cmath>

namespace navcal::nav {
namespace {

using Eigen::Vector2d;

/// A stretch without fixes that is worth a word.
constexpr double kOutage_s = 10;

double speed_error(const Way& way, const ReckoningOptions& options) {
  return way.source == SpeedSource::shaft || way.source == SpeedSource::none ? options.speed_error
                                                                             : way.scale_error;
}

Vector2d turned(const Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

DeadReckoning::DeadReckoning(const ReckoningOptions& options)
    : options_(options), set_variance_m2_s2_(options.set_m_s * options.set_m_s) {}

void DeadReckoning::advance(const Way& way) {
  const double dt = way.duration_s;
  if (dt > 0) last_way_ = way;
  const double run_m = way.speed_m_s * dt;
  const Vector2d step_m = way.heading_known ? Vector2d(run_m * way.ahead) : Vector2d::Zero();
  const bool over_bottom = way.source == SpeedSource::bottom;
  reckoned_m_ += step_m;
  // The correction below moves with the set.
  if (over_bottom) reckoned_m_ -= set_m_s_ * dt;
  since_fix_s_ += dt;
  since_fix_m_ += std::abs(run_m);
  (over_bottom ? bottom_across_m_ : across_m_) += way.heading_std_rad * step_m;
  if (way.set_turns && !over_bottom) across_m_ += way.heading_std_rad * set_m_s_ * dt;
  (over_bottom ? bottom_along_m_ : along_m_) += speed_error(way, options_) * step_m;
  if (!way.speed_known) {
    blind_m_ += options_.unknown_speed_m_s * dt;
  } else if (!way.heading_known) {
    blind_m_ += std::abs(run_m);
  }

  correction_m_ += set_m_s_ * dt;
  const double kept = std::exp(-dt / options_.set_time_s);
  const double stationary_m2_s2 = options_.set_m_s * options_.set_m_s;
  if (over_bottom) {
    variance_m2_ += (options_.bottom_walk_m2_per_s + way.noise_m2_per_s) * dt;
    covariance_m2_s_ *= kept;
  } else {
    const double walk_m2_per_s = options_.walk_m2_per_s + way.noise_m2_per_s;
    variance_m2_ += (2 * covariance_m2_s_ + set_variance_m2_s2_ * dt + walk_m2_per_s) * dt;
    covariance_m2_s_ = kept * (covariance_m2_s_ + set_variance_m2_s2_ * dt);
  }
  set_variance_m2_s2_ = kept * kept * set_variance_m2_s2_ + (1 - kept * kept) * stationary_m2_s2;
  set_m_s_ *= kept;
}

/// Contribution of constant errors to the variance of north and east. The heading's is the same over the bottom
/// and through the water, the speed's is not.
Vector2d DeadReckoning::standing_variance_m2() const {
  return (turned(across_m_ + bottom_across_m_).cwiseAbs2() + along_m_.cwiseAbs2() + bottom_along_m_.cwiseAbs2())
             .array() +
         blind_m_ * blind_m_;
}

Vector2d DeadReckoning::std_m() const { return (standing_variance_m2().array() + variance_m2_).sqrt(); }

/// The part of the variance in `after_s` that is the same in all directions: that of advance(), integrated. The
/// set is forgotten with the time constant memory_s.
double DeadReckoning::even_variance_m2(double after_s) const {
  double blind_m = blind_m_;
  if (!last_way_.speed_known) {
    blind_m += options_.unknown_speed_m_s * after_s;
  } else if (!last_way_.heading_known) {
    blind_m += std::abs(last_way_.speed_m_s) * after_s;
  }
  if (last_way_.source == SpeedSource::bottom) {
    const double walk_m2_per_s = options_.bottom_walk_m2_per_s + last_way_.noise_m2_per_s;
    return variance_m2_ + walk_m2_per_s * after_s + blind_m * blind_m;
  }
  const double memory_s = options_.set_time_s, lost_s = -memory_s * std::expm1(-after_s / memory_s);
  const double stationary_m2_s2 = options_.set_m_s * options_.set_m_s;
  const double covariance_part = covariance_m2_s_ * lost_s + stationary_m2_s2 * memory_s * (after_s - lost_s) +
                                 (set_variance_m2_s2_ - stationary_m2_s2) * lost_s * lost_s / 2;
  const double walk_m2_per_s = options_.walk_m2_per_s + last_way_.noise_m2_per_s;
  return variance_m2_ + walk_m2_per_s * after_s + 2 * covariance_part + blind_m * blind_m;
}

Eigen::Matrix2d DeadReckoning::covariance_m2(double after_s) const {
  const Vector2d step_m = last_way_.heading_known ? Vector2d(last_way_.speed_m_s * after_s * last_way_.ahead)
                                                  : Vector2d(Vector2d::Zero());
  Vector2d turning_m = step_m;
  if (last_way_.set_turns && last_way_.source != SpeedSource::bottom) turning_m += set_m_s_ * after_s;
  const Vector2d across_m = turned(across_m_ + bottom_across_m_ + last_way_.heading_std_rad * turning_m);
  Vector2d along_m = along_m_, bottom_along_m = bottom_along_m_;
  (last_way_.source == SpeedSource::bottom ? bottom_along_m : along_m) +=
      speed_error(last_way_, options_) * step_m;
  return across_m * across_m.transpose() + along_m * along_m.transpose() +
         bottom_along_m * bottom_along_m.transpose() + even_variance_m2(after_s) * Eigen::Matrix2d::Identity();
}

void DeadReckoning::observe_set(const Vector2d& set_m_s, double std_m_s) {
  const double innovation_m2_s2 = set_variance_m2_s2_ + std_m_s * std_m_s;
  const double gain_s = covariance_m2_s_ / innovation_m2_s2, set_gain = set_variance_m2_s2_ / innovation_m2_s2;
  const Vector2d difference_m_s = set_m_s - set_m_s_;
  correction_m_ += gain_s * difference_m_s;
  set_m_s_ += set_gain * difference_m_s;
  variance_m2_ -= gain_s * covariance_m2_s_;
  covariance_m2_s_ *= 1 - set_gain;
  set_variance_m2_s2_ *= 1 - set_gain;
}

/// Errors over the bottom stay what they are: the fix only lessens what they cost so far. Here they count as
/// independent of those through the water: both could cancel each other, but only the latter end with the fix.
void DeadReckoning::apply(const FixReading& fix, const Vector2d& difference_m) {
  const Vector2d ended_m2 = (turned(across_m_).cwiseAbs2() + along_m_.cwiseAbs2()).array() + blind_m_ * blind_m_;
  const double noise_m2 = fix.std_m * fix.std_m;
  const double considered_m2 = (bottom_across_m_.squaredNorm() + bottom_along_m_.squaredNorm()) / 2;
  const double prior_m2 = variance_m2_ + ended_m2.mean() + considered_m2;
  const double gain = prior_m2 / (prior_m2 + noise_m2);
  const double set_gain_per_s = covariance_m2_s_ / (prior_m2 + noise_m2);
  correction_m_ += gain * difference_m;
  set_m_s_ += set_gain_per_s * difference_m;
  set_variance_m2_s2_ -= set_gain_per_s * covariance_m2_s_;
  covariance_m2_s_ *= 1 - gain;
  variance_m2_ = (1 - gain) * prior_m2 - (1 - gain) * (1 - gain) * considered_m2;
  bottom_across_m_ *= 1 - gain;
  bottom_along_m_ *= 1 - gain;
}

std::optional<Outage> DeadReckoning::fix(const FixReading& fix, const Vector2d& reckoned_m, double before_s) {
  const Vector2d predicted_m = reckoned_m + correction_m_ - set_m_s_ * before_s;
  const Vector2d difference_m = fix.position_m - predicted_m;
  const double noise_m2 = fix.std_m * fix.std_m;
  std::optional<Outage> outage;
  if (!known_) {
    correction_m_ += difference_m;
    variance_m2_ = noise_m2;
    covariance_m2_s_ = 0;
    bottom_across_m_.setZero();
    bottom_along_m_.setZero();
    known_ = true;
  } else {
    const double stated_m2 = 2 * (variance_m2_ + noise_m2) + standing_variance_m2().sum();
    if (since_fix_s_ - before_s >= kOutage_s)
      outage = {since_fix_s_ - before_s, since_fix_m_, difference_m.norm(), std::sqrt(stated_m2)};
    apply(fix, difference_m);
  }
  across_m_.setZero();
  along_m_.setZero();
  blind_m_ = 0;
  since_fix_s_ = before_s;
  since_fix_m_ = 0;
  return outage;
}

double radius_95_m(const Eigen::Matrix2d& covariance_m2) {
  const double mean = covariance_m2.trace() / 2;
  const double half_difference = std::hypot((covariance_m2(0, 0) - covariance_m2(1, 1)) / 2, covariance_m2(0, 1));
  const double long_axis = std::sqrt(std::max(mean + half_difference, 0.0));
  if (long_axis == 0) return 0;
  const double share = std::sqrt(std::max(mean - half_difference, 0.0)) / long_axis;
  return long_axis * (1.960790 + share * (0.004071 + share * (0.114276 + share * 0.371625)));
}

}  // namespace navcal::nav
