// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_water_speed.h"

#include <algorithm>
#include <cmath>

namespace navcal::calib {

double WaterSpeed::advanced(double duration_s) const {
  const double goal_m_s = parameters_.advance_m * revolutions_per_s_;
  double speed_m_s = speed_m_s_;
  double left_s = std::min(duration_s, 20 * parameters_.way_m / (0.1 + goal_m_s));  // it has settled long before
  while (left_s > 0) {
    const double step_s = std::min(left_s, parameters_.longest_step_s);
    // Implicit in the difference, so that no step overshoots.
    const double rate_per_s = std::abs(speed_m_s + goal_m_s) / (2 * parameters_.way_m);
    speed_m_s = (speed_m_s + step_s * rate_per_s * goal_m_s) / (1 + step_s * rate_per_s);
    left_s -= step_s;
  }
  return speed_m_s;
}

void WaterSpeed::update(const MotorReading& motor) {
  if (!motor.rpm || !std::isfinite(motor.time_s + *motor.rpm) || (started_ && motor.time_s <= time_s_)) return;
  if (started_) speed_m_s_ = advanced(motor.time_s - time_s_);
  revolutions_per_s_ = std::max(0.0, *motor.rpm / 60);  // astern the propeller gives nothing
  // It is unknown whether the vehicle has just started; a vehicle under way is more probable.
  if (!started_) speed_m_s_ = parameters_.advance_m * revolutions_per_s_;
  started_ = true;
  time_s_ = motor.time_s;
}

std::optional<double> WaterSpeed::at(double time_s) const {
  if (!started_ || !std::isfinite(time_s)) return std::nullopt;
  return time_s > time_s_ ? advanced(time_s - time_s_) : speed_m_s_;
}

void WaterSpeed::archive(Archive& archive) {
  archive.tag("water_speed 1");
  archive(started_, time_s_, speed_m_s_, revolutions_per_s_);
}

}  // namespace navcal::calib
