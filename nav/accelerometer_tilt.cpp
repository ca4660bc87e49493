// SPDX-License-Identifier: Apache-2.0
#include "nav/accelerometer_tilt.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/durations.h"
#include "base/gravity.h"
#include "nav/readings.h"

namespace navcal::nav {
namespace {

using Eigen::Vector3d;

/// A velocity by fixes that is older says nothing of the speed now.
constexpr double kFixPause_s = 3;
/// The specific force that the accelerometers would feel at the vehicle's origin: without w x (w x r) + dw/dt x r
/// at their place r.
Vector3d force_at_origin(const RateReading& reading, const Vector3d& rate_rad_s,
                         const Vector3d& rate_change_rad_s2) {
  const Vector3d& force_m_s2 = *reading.specific_force_m_s2;
  const Vector3d& position_m = reading.force_position_m;
  if (position_m.isZero(0)) return force_m_s2;
  return force_m_s2 - rate_rad_s.cross(rate_rad_s.cross(position_m)) - rate_change_rad_s2.cross(position_m);
}

/// Gravity that is left must be gravity: within so much of 9.81 m/s2. A blow or a fall says nothing of the tilt.
constexpr double kGravityWithin_m_s2 = 1.5;

AttitudeOptions attitude_options(const AccelerometerTiltOptions& options) {
  AttitudeOptions attitude;
  attitude.tilt_gain_per_s = options.tilt_gain_per_s;
  attitude.tilt_zero_gain_per_s2 = options.tilt_zero_gain_per_s2;
  return attitude;
}

}  // namespace

AccelerometerTilt::AccelerometerTilt(const AccelerometerTiltOptions& options)
    : options_(options), attitude_(attitude_options(options)) {}

void AccelerometerTilt::take(const RateReading& reading) {
  if (!reading.specific_force_m_s2 || (time_ns_ && reading.time_ns <= *time_ns_)) return;
  if (!reading.specific_force_m_s2->allFinite()) return;
  if (!(reading.rate_rad_s.array().abs() <= kMostRate_rad_s).all()) return;
  const double duration_s = time_ns_ ? base::seconds(reading.time_ns - *time_ns_) : 0;
  Vector3d rate_change_rad_s2 = Vector3d::Zero();
  if (time_ns_ && duration_s <= kRatePause_s) {
    rate_change_rad_s2 = (reading.rate_rad_s - rate_rad_s_) / duration_s;
    attitude_.turn((rate_rad_s_ + reading.rate_rad_s) / 2, duration_s);
  } else {
    attitude_.lose_track();
    past_.clear();
  }
  time_ns_ = reading.time_ns;
  rate_rad_s_ = reading.rate_rad_s;
  move_speed(reading.time_ns, duration_s);
  const Vector3d rate = reading.rate_rad_s + attitude_.zero_rad_s();
  const Vector3d moved = Vector3d(acceleration_m_s2_, 0, 0) + rate.cross(Vector3d(speed_m_s_, 0, 0));
  const Vector3d gravity = moved - force_at_origin(reading, rate, rate_change_rad_s2);  // in body axes
  if (std::abs(gravity.norm() - base::kGravity_m_s2) <= kGravityWithin_m_s2) {
    const double roll_rad = std::atan2(gravity.y(), gravity.z());
    const double pitch_rad = std::atan2(-gravity.x(), std::hypot(gravity.y(), gravity.z()));
    const Eigen::Vector2d turned = attitude_.correct_tilt(base::wrapped(roll_rad - attitude_.roll_rad()),
                                                          pitch_rad - attitude_.pitch_rad(), duration_s);
    past_.correct({turned.x(), turned.y(), 0});
  }
  if (attitude_.tilt_known()) past_.push({*time_ns_, attitude_.roll_rad(), attitude_.pitch_rad(), 0, {}});
}

void AccelerometerTilt::take(const ShaftReading& reading) {
  shaft_ns_ = reading.time_ns;
  shaft_per_s_ = reading.revolutions_per_s;
}

void AccelerometerTilt::take(const FixReading& reading) {
  if (!reading.velocity_m_s) return;
  ground_ns_ = reading.time_ns;
  ground_speed_m_s_ = reading.velocity_m_s->norm();
}

void AccelerometerTilt::move_speed(std::int64_t time_ns, double duration_s) {
  acceleration_m_s2_ = 0;
  const bool by_shaft =
      options_.advance_m > 0 && shaft_ns_ && base::seconds(time_ns - *shaft_ns_) <= kShaftPause_s;
  if (by_shaft) {
    const double target_m_s = options_.advance_m * std::max(shaft_per_s_, 0.0);
    if (speed_by_shaft_ && options_.speed_lag_s > 0) {
      const double before_m_s = speed_m_s_;
      speed_m_s_ += (speed_m_s_ - target_m_s) * std::expm1(-duration_s / options_.speed_lag_s);
      if (duration_s > 0) acceleration_m_s2_ = (speed_m_s_ - before_m_s) / duration_s;
    } else {
      speed_m_s_ = target_m_s;
    }
  } else {
    const bool by_fixes = ground_ns_ && base::seconds(time_ns - *ground_ns_) <= kFixPause_s;
    speed_m_s_ = by_fixes ? ground_speed_m_s_ : 0;
  }
  speed_by_shaft_ = by_shaft;
}

std::optional<TiltReading> AccelerometerTilt::at(std::int64_t time_ns) const {
  const auto pose = past_.at(time_ns);
  if (!pose) return std::nullopt;
  return TiltReading{time_ns, pose->roll_rad, pose->pitch_rad};
}

std::optional<TiltReading> AccelerometerTilt::newest() const {
  if (!time_ns_ || !attitude_.tilt_known()) return std::nullopt;
  return TiltReading{*time_ns_, attitude_.roll_rad(), attitude_.pitch_rad()};
}

}  // namespace navcal::nav
