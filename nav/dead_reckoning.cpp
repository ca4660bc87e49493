// SPDX-License-Identifier: Apache-2.0
#include "nav/dead_reckoning.h"

#include <cmath>

namespace navcal::nav {
namespace {

using Eigen::Vector2d;

/// A stretch without fixes that is worth a word.
constexpr double kOutage_s = 10;

}  // namespace

DeadReckoning::DeadReckoning(const ReckoningOptions& options)
    : options_(options), set_variance_m2_s2_(options.set_m_s * options.set_m_s) {}

void DeadReckoning::advance(const Way& way) {
  const double dt = way.duration_s;
  if (dt > 0) last_way_ = way;
  const double run_m = way.speed_m_s * dt;
  const Vector2d step_m = way.heading_known ? Vector2d(run_m * way.ahead) : Vector2d::Zero();
  reckoned_m_ += step_m;
  since_fix_s_ += dt;
  since_fix_m_ += std::abs(run_m);
  across_m_ += way.heading_std_rad * step_m;
  along_m_ += options_.speed_error * step_m;
  if (!way.speed_known) {
    blind_m_ += options_.unknown_speed_m_s * dt;
  } else if (!way.heading_known) {
    blind_m_ += std::abs(run_m);
  }

  correction_m_ += set_m_s_ * dt;
  const double kept = std::exp(-dt / options_.set_time_s);
  const double stationary_m2_s2 = options_.set_m_s * options_.set_m_s;
  variance_m2_ += (2 * covariance_m2_s_ + set_variance_m2_s2_ * dt + options_.walk_m2_per_s) * dt;
  covariance_m2_s_ = kept * (covariance_m2_s_ + set_variance_m2_s2_ * dt);
  set_variance_m2_s2_ = kept * kept * set_variance_m2_s2_ + (1 - kept * kept) * stationary_m2_s2;
  set_m_s_ *= kept;
}

/// Contribution of constant errors to the variance of north and east.
Vector2d DeadReckoning::standing_variance_m2() const {
  const Vector2d turned(across_m_.y(), across_m_.x());
  return (turned.cwiseAbs2() + along_m_.cwiseAbs2()).array() + blind_m_ * blind_m_;
}

Vector2d DeadReckoning::std_m() const { return (standing_variance_m2().array() + variance_m2_).sqrt(); }

Eigen::Matrix2d DeadReckoning::covariance_m2(double after_s) const {
  const Vector2d step_m = last_way_.heading_known ? Vector2d(last_way_.speed_m_s * after_s * last_way_.ahead)
                                                  : Vector2d(Vector2d::Zero());
  const Vector2d across_m = across_m_ + last_way_.heading_std_rad * step_m;
  const Vector2d along_m = along_m_ + options_.speed_error * step_m, turned_m(-across_m.y(), across_m.x());
  double blind_m = blind_m_;
  if (!last_way_.speed_known) {
    blind_m += options_.unknown_speed_m_s * after_s;
  } else if (!last_way_.heading_known) {
    blind_m += std::abs(last_way_.speed_m_s) * after_s;
  }
  // The variances of advance(), integrated over `after_s`: the set is forgotten with the time constant memory_s.
  const double memory_s = options_.set_time_s, lost_s = -memory_s * std::expm1(-after_s / memory_s);
  const double stationary_m2_s2 = options_.set_m_s * options_.set_m_s;
  const double covariance_part = covariance_m2_s_ * lost_s + stationary_m2_s2 * memory_s * (after_s - lost_s) +
                                 (set_variance_m2_s2_ - stationary_m2_s2) * lost_s * lost_s / 2;
  const double even_m2 = variance_m2_ + options_.walk_m2_per_s * after_s + 2 * covariance_part + blind_m * blind_m;
  return turned_m * turned_m.transpose() + along_m * along_m.transpose() + even_m2 * Eigen::Matrix2d::Identity();
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

std::optional<Outage> DeadReckoning::fix(const FixReading& fix, const Vector2d& reckoned_m, double before_s) {
  const Vector2d predicted_m = reckoned_m + correction_m_ - set_m_s_ * before_s;
  const Vector2d difference_m = fix.position_m - predicted_m;
  const double noise_m2 = fix.std_m * fix.std_m;
  std::optional<Outage> outage;
  if (!known_) {
    correction_m_ += difference_m;
    variance_m2_ = noise_m2;
    covariance_m2_s_ = 0;
    known_ = true;
  } else {
    const double stated_m2 = 2 * (variance_m2_ + noise_m2) + standing_variance_m2().sum();
    if (since_fix_s_ - before_s >= kOutage_s)
      outage = {since_fix_s_ - before_s, since_fix_m_, difference_m.norm(), std::sqrt(stated_m2)};
    const double prior_m2 = variance_m2_ + standing_variance_m2().mean();
    const double gain = prior_m2 / (prior_m2 + noise_m2);
    const double set_gain_per_s = covariance_m2_s_ / (prior_m2 + noise_m2);
    correction_m_ += gain * difference_m;
    set_m_s_ += set_gain_per_s * difference_m;
    set_variance_m2_s2_ -= set_gain_per_s * covariance_m2_s_;
    covariance_m2_s_ *= 1 - gain;
    variance_m2_ = (1 - gain) * prior_m2;
  }
  across_m_.setZero();
  along_m_.setZero();
  blind_m_ = 0;
  since_fix_s_ = before_s;
  since_fix_m_ = 0;
  return outage;
}

}  // namespace navcal::nav
