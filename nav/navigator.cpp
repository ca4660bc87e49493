// SPDX-License-Identifier: Apache-2.0
#include "nav/navigator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/durations.h"
#include "base/rotation.h"
#include "nav/dead_reckoning.h"
#include "nav/readings.h"

namespace navcal::nav {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A turn within the second before a fix makes its velocity so many times worse than the reckoned one changed.
constexpr double kChangeShare = 2;
/// How a heading that no compass holds gets lost: by a zero of the gyros not known, and with no gyros at all.
constexpr double kGyroDrift_rad_s = 0.005, kBlindDrift_rad_s = 0.2;
/// A heading of which nothing is known: uniform around the circle.
const double kAnyHeading_rad = std::numbers::pi / std::sqrt(3.0);

/// Readings beyond these limits are faults of any instrument. A value that is not finite exceeds all limits.
constexpr double kMostDepth_m = 12'000, kMostAngle_rad = 100, kMostShaft_per_s = 1000;
constexpr double kMostPosition_m = 2e7, kMostVelocity_m_s = 1e4, kLeastFixStd_m = 1e-3, kMostFixStd_m = 1e5;

bool within(double value, double most) { return std::abs(value) <= most; }
bool within(const std::optional<double>& value, double most) { return !value || within(*value, most); }
bool plausible(const RateReading& r) {
  return (r.rate_rad_s.array().abs() <= kMostRate_rad_s).all() && within(r.depth_m, kMostDepth_m);
}
bool plausible(const TiltReading& r) {
  return within(r.roll_rad, kMostAngle_rad) && within(r.pitch_rad, kMostAngle_rad);
}
bool plausible(const CompassReading& r) {
  return within(r.heading_rad, kMostAngle_rad) && within(r.pitch_rad, kMostAngle_rad) &&
         within(r.roll_rad, kMostAngle_rad);
}
bool plausible(const ShaftReading& r) { return within(r.revolutions_per_s, kMostShaft_per_s); }
bool plausible(const FixReading& r) {
  if (r.velocity_m_s && !(r.velocity_m_s->array().abs() <= kMostVelocity_m_s).all()) return false;
  if (!(r.velocity_std_m_s >= kLeastFixStd_m && r.velocity_std_m_s <= kMostFixStd_m)) return false;
  return (r.position_m.array().abs() <= kMostPosition_m).all() && r.std_m >= kLeastFixStd_m &&
         r.std_m <= kMostFixStd_m;
}

}  // namespace

Navigator::Navigator(const Options& options)
    : options_(options), attitude_(options.attitude), depth_(options.depth), reckoning_(options.reckoning) {}

bool Navigator::is_new(Last& last, std::int64_t time_ns, bool plausible) {
  if (!plausible || (last && time_ns <= *last)) {
    ++left_out_;
    return false;
  }
  last = time_ns;
  return true;
}

std::optional<Pose> Navigator::pose_for(Last& last, std::int64_t time_ns, bool plausible) {
  if (!is_new(last, time_ns, plausible)) return std::nullopt;
  drive(time_ns);
  auto pose = past_.at(time_ns);
  if (!pose) ++left_out_;
  return pose;
}

bool Navigator::rates_come(std::int64_t time_ns) const {
  return rates_ns_ && base::seconds(time_ns - *rates_ns_) <= kRatePause_s;
}

void Navigator::take(const RateReading& reading) {
  const Last before_ns = rates_ns_;
  if (!is_new(rates_ns_, reading.time_ns, plausible(reading))) return;
  const bool follows = before_ns && base::seconds(reading.time_ns - *before_ns) <= kRatePause_s;
  const Vector3d mean_rate_rad_s = (rate_rad_s_ + reading.rate_rad_s) / 2;
  rate_rad_s_ = reading.rate_rad_s;
  // Others may have driven the time beyond the first frames after a pause.
  if (time_ns_ && reading.time_ns <= *time_ns_) return;
  advance(reading.time_ns, follows ? std::optional(mean_rate_rad_s) : std::nullopt);
  if (reading.depth_m) correct_depth(*reading.depth_m, reading.depth_position_m, reading.depth_std_m);
}

void Navigator::take(const CompassReading& reading) {
  // A tilt alone makes no heading old that is measured before it.
  Last& last = reading.heading_rad ? compass_ns_ : tilt_reading_ns_;
  const auto pose = pose_for(last, reading.time_ns, plausible(reading));
  if (!pose) return;
  if (reading.roll_rad && reading.pitch_rad && (!tilt_ns_ || reading.time_ns > *tilt_ns_)) {
    // The fluid shows the tilt of some time ago.
    const double lag_s = reading.tilt_lags ? options_.attitude.tilt_lag_s : 0;
    const std::int64_t felt_ns = reading.time_ns - std::llround(lag_s * 1e9);
    const Pose felt = past_.at(felt_ns).value_or(*pose);
    const double since_s = tilt_ns_ ? base::seconds(reading.time_ns - *tilt_ns_) : 0;
    const Vector2d turned = attitude_.correct_tilt(base::wrapped(*reading.roll_rad - felt.roll_rad),
                                                   *reading.pitch_rad - felt.pitch_rad, since_s);
    past_.correct({turned.x(), turned.y(), 0});
    tilt_ns_ = reading.time_ns;
  }
  if (reading.heading_rad) {
    const double since_s = heading_ns_ ? base::seconds(reading.time_ns - *heading_ns_) : 0;
    const double turned =
        attitude_.correct_heading(base::wrapped(*reading.heading_rad - pose->heading_rad), since_s);
    past_.correct({0, 0, turned});
    heading_ns_ = reading.time_ns;
    heading_error_rad_ = reading.calibrated ? options_.heading_error_calibrated_rad
                                            : std::max(options_.heading_error_rad, reading.heading_std_rad);
    drift_rad_ = 0;
  }
}

void Navigator::turn_north(double change_rad) {
  attitude_.turn_north(change_rad);
  past_.correct({0, 0, change_rad});
}

void Navigator::take(const TiltReading& reading) {
  const auto pose = pose_for(tilt_reading_ns_, reading.time_ns, plausible(reading));
  if (!pose) return;
  const double since_s = tilt_ns_ ? base::seconds(reading.time_ns - *tilt_ns_) : 0;
  const Vector2d turned = attitude_.correct_tilt(base::wrapped(reading.roll_rad - pose->roll_rad),
                                                 reading.pitch_rad - pose->pitch_rad, since_s);
  past_.correct({turned.x(), turned.y(), 0});
  tilt_ns_ = reading.time_ns;
}

void Navigator::take(const ShaftReading& reading) {
  if (!is_new(shaft_ns_, reading.time_ns, plausible(reading))) return;
  drive(reading.time_ns);
  revolutions_per_s_ = reading.revolutions_per_s;
}

void Navigator::take(const FixReading& reading) {
  const auto pose = pose_for(fix_ns_, reading.time_ns, plausible(reading));
  if (!pose) return;
  if (const auto outage = reckoning_.fix(reading, pose->reckoned_m, base::seconds(*time_ns_ - reading.time_ns)))
    outage_ = outage;
  // The way of the last second must have been one through the water.
  const bool over_bottom = over_bottom_ns_ && *over_bottom_ns_ >= reading.time_ns - base::kSecond_ns;
  if (reading.velocity_m_s && source_ != SpeedSource::none && attitude_.heading_known() && !over_bottom)
    observe_set(reading);
}

/// A receiver's velocity is a mean over about the second before: what changed within it is no measure of the set.
void Navigator::observe_set(const FixReading& reading) {
  const auto now = past_.at(reading.time_ns), half = past_.at(reading.time_ns - base::kSecond_ns / 2),
             full = past_.at(reading.time_ns - base::kSecond_ns);
  if (!now || !half || !full) return;
  const Vector2d newer_m = now->reckoned_m - half->reckoned_m, older_m = half->reckoned_m - full->reckoned_m;
  const double change_m_s = 2 * (newer_m - older_m).norm();
  reckoning_.observe_set(*reading.velocity_m_s - 2 * newer_m,
                         std::hypot(reading.velocity_std_m_s, kChangeShare * change_m_s));
}

void Navigator::drive(std::int64_t time_ns) {
  if (rates_come(time_ns) || (time_ns_ && time_ns <= *time_ns_)) return;
  advance(time_ns, std::nullopt);
}

void Navigator::advance(std::int64_t time_ns, const std::optional<Vector3d>& mean_rate_rad_s) {
  const double duration_s = time_ns_ ? base::seconds(time_ns - *time_ns_) : 0;
  time_ns_ = time_ns;
  Way way;
  way.duration_s = duration_s;
  way.heading_std_rad = heading_std_rad();
  const Vector2d ahead_before = ahead();
  const HeldVelocity* const held = held_velocity();
  const Vector3d held_before_m_s = held != nullptr ? measured_m_s(*held) : Vector3d(Vector3d::Zero());
  if (mean_rate_rad_s) {
    attitude_.turn(*mean_rate_rad_s, duration_s);
  } else {
    attitude_.lose_track();
  }
  drift_rad_ += (mean_rate_rad_s ? kGyroDrift_rad_s : kBlindDrift_rad_s) * duration_s;
  way.ahead = (ahead_before + ahead()) / 2;
  way.heading_known = attitude_.heading_known();
  const double speed_before_m_s = speed_m_s_;
  move_speed(duration_s);
  way.speed_known = speed_known_;
  way.speed_m_s = speed_known_ ? (speed_before_m_s + speed_m_s_) / 2 : 0;
  double sinking_m_s = attitude_.tilt_known() ? -way.speed_m_s * std::sin(attitude_.pitch_rad()) : 0;
  way.source = speed_known_ ? SpeedSource::shaft : SpeedSource::none;
  if (held != nullptr) {
    measure(way, *held, held_before_m_s);
    if (attitude_.tilt_known()) sinking_m_s = measured_m_s(*held).z();
  }
  source_ = way.source;
  way.set_turns = over_bottom_ns_.has_value();
  if (source_ == SpeedSource::bottom) over_bottom_ns_ = time_ns;
  reckoning_.advance(way);
  depth_.advance(sinking_m_s, duration_s);
  past_.push(
      {time_ns, attitude_.roll_rad(), attitude_.pitch_rad(), attitude_.heading_rad(), reckoning_.reckoned_m()});
}

/// The vehicle's speed follows its shaft's; a propeller that turns backwards gives nothing.
void Navigator::move_speed(double duration_s) {
  const bool shaft_comes = shaft_ns_ && base::seconds(*time_ns_ - *shaft_ns_) <= kShaftPause_s;
  const bool known = shaft_comes && options_.advance_m > 0;
  const double target_m_s = known ? options_.advance_m * std::max(revolutions_per_s_, 0.0) : 0;
  if (known && speed_known_ && options_.speed_lag_s > 0) {
    speed_m_s_ += (speed_m_s_ - target_m_s) * std::expm1(-duration_s / options_.speed_lag_s);
  } else {
    speed_m_s_ = target_m_s;
  }
  speed_known_ = known;
}

Vector2d Navigator::ahead() const {
  return std::cos(attitude_.pitch_rad()) *
         Vector2d(std::cos(attitude_.heading_rad()), std::sin(attitude_.heading_rad()));
}

double Navigator::heading_std_rad() const {
  if (!attitude_.heading_known()) return kAnyHeading_rad;
  return std::min(std::hypot(heading_error_rad_, drift_rad_), kAnyHeading_rad);
}

Estimate Navigator::estimate() const {
  Estimate estimate;
  estimate.time_ns = time_ns();
  estimate.heading_std_rad = heading_std_rad();
  if (attitude_.heading_known()) estimate.heading_rad = base::as_heading(attitude_.heading_rad());
  if (attitude_.tilt_known()) {
    estimate.pitch_rad = attitude_.pitch_rad();
    estimate.roll_rad = attitude_.roll_rad();
  }
  estimate.depth_m = depth_.depth_m();
  estimate.depth_std_m = depth_.std_m();
  if (const auto speed_m_s = speed_through_water_m_s()) estimate.speed_m_s = speed_m_s;
  estimate.speed_source = source_;
  estimate.velocity_outliers = velocity_outliers();
  estimate.set_m_s = reckoning_.set_m_s();
  if (const auto level_m_s = level_velocity_m_s())
    estimate.velocity_m_s = Vector3d(level_m_s->x(), level_m_s->y(), depth_.sinking_m_s());
  if (reckoning_.known()) {
    estimate.position_m = reckoning_.position_m();
    estimate.position_std_m = reckoning_.std_m();
    estimate.since_fix_s = reckoning_.since_fix_s();
    estimate.since_fix_m = reckoning_.since_fix_m();
  }
  return estimate;
}

std::optional<Pose> Navigator::attitude_at(std::int64_t time_ns) const {
  return attitude_.heading_known() ? past_.at(time_ns) : std::nullopt;
}

std::optional<double> Navigator::error_radius_m(double after_s) const {
  if (!reckoning_.known()) return std::nullopt;
  return radius_95_m(reckoning_.covariance_m2(after_s));
}

std::optional<Outage> Navigator::take_outage() { return std::exchange(outage_, std::nullopt); }

}  // namespace navcal::nav
