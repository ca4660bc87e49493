// SPDX-License-Identifier: Apache-2.0
#include "nav/altitude_filter.h"

#include <cmath>

namespace navcal::nav {
namespace {

constexpr std::int64_t kAltitudePause_ns = 2'000'000'000;
constexpr double kOutlierStds = 5;
constexpr int kOutliersInARow = 3;
/// Rate of an altitude that begins, one standard deviation.
constexpr double kFirstRate_m_s = 1;

}  // namespace

bool AltitudeFilter::take(std::int64_t time_ns, double range_m, double pitch_rad, double roll_rad) {
  if (!std::isfinite(range_m) || range_m < 0 || range_m > options_.range_m) return false;
  if (!std::isfinite(pitch_rad) || !std::isfinite(roll_rad)) return false;
  const double cosine = std::cos(pitch_rad) * std::cos(roll_rad);
  if (cosine <= 0.1 || (time_ns_ && time_ns <= newest_ns_)) return false;
  const double altitude_m = range_m * cosine;
  const double tilt_rad = std::acos(std::fmin(cosine, 1.0));
  const double variance_m2 = std::pow(options_.noise_m * cosine, 2);
  const double by_tilt_m = range_m * std::sin(tilt_rad) * options_.tilt_error_rad;
  newest_ns_ = time_ns;
  by_tilt_m_ = by_tilt_m;
  if (!time_ns_ || time_ns - *time_ns_ > kAltitudePause_ns) {
    begin(altitude_m, variance_m2);
    return true;
  }
  const State before = predicted(static_cast<double>(time_ns - *time_ns_) * 1e-9);
  const double innovation_m = altitude_m - before.mean[0];
  const double innovation_m2 = before.covariance(0, 0) + variance_m2;
  const double gate_m2 = kOutlierStds * kOutlierStds * (innovation_m2 + by_tilt_m * by_tilt_m);
  if (innovation_m * innovation_m > gate_m2) {
    if (++outliers_ < kOutliersInARow) return false;
    begin(altitude_m, variance_m2);
    return true;
  }
  outliers_ = 0;
  time_ns_ = time_ns;
  const Eigen::Vector2d gain = before.covariance.col(0) / innovation_m2;
  state_.mean = before.mean + gain * innovation_m;
  state_.covariance = before.covariance - gain * before.covariance.row(0);
  return true;
}

void AltitudeFilter::begin(double altitude_m, double variance_m2) {
  time_ns_ = newest_ns_;
  outliers_ = 0;
  state_.mean = {altitude_m, 0};
  state_.covariance.setZero();
  state_.covariance.diagonal() << variance_m2, kFirstRate_m_s * kFirstRate_m_s;
}

AltitudeFilter::State AltitudeFilter::predicted(double duration_s) const {
  Eigen::Matrix2d transition;
  transition << 1, duration_s, 0, 1;
  State state;
  state.mean = transition * state_.mean;
  state.covariance = transition * state_.covariance * transition.transpose();
  // White in time: one second of it changes the rate by the standard deviation of the options.
  const double q = options_.acceleration_m_s2 * options_.acceleration_m_s2;
  state.covariance(0, 0) += q * std::pow(duration_s, 3) / 3;
  state.covariance(0, 1) += q * duration_s * duration_s / 2;
  state.covariance(1, 0) += q * duration_s * duration_s / 2;
  state.covariance(1, 1) += q * duration_s;
  return state;
}

std::optional<Altitude> AltitudeFilter::at(std::int64_t time_ns) const {
  if (!time_ns_ || time_ns - *time_ns_ > kAltitudePause_ns) return std::nullopt;
  const double duration_s = std::fmax(0.0, static_cast<double>(time_ns - *time_ns_) * 1e-9);
  const State state = predicted(duration_s);
  return Altitude{std::fmax(0.0, state.mean[0]), std::hypot(std::sqrt(state.covariance(0, 0)), by_tilt_m_),
                  state.mean[1], std::sqrt(state.covariance(1, 1))};
}

}  // namespace navcal::nav
