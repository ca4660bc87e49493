// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/current_track.h"

#include <algorithm>

namespace navcal::calib {

void CurrentTrack::update(const MotorReading& motor) {
  if (!motor.current_A) return;
  points_[next_] = {motor.time_s, *motor.current_A};
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
}

std::optional<double> CurrentTrack::at(double time_s) const {
  for (std::size_t age = 0; age + 1 < count_; ++age) {
    const Point &after = back(age), &before = back(age + 1);
    if (after.time_s < time_s) return std::nullopt;
    if (before.time_s > time_s) continue;
    const double length_s = after.time_s - before.time_s;
    if (length_s > kLongest_s) return std::nullopt;
    const double share = length_s > 0 ? (time_s - before.time_s) / length_s : 1;
    return before.current_A + share * (after.current_A - before.current_A);
  }
  return std::nullopt;
}

std::optional<double> CurrentTrack::newest(double time_s) const {
  if (count_ == 0 || time_s - back(0).time_s > kLongest_s) return std::nullopt;
  return back(0).current_A;
}

std::optional<double> CurrentTrack::at_or_newest(double time_s) const {
  const auto between = at(time_s);
  return between ? between : newest(time_s);
}

void CurrentTrack::archive(Archive& archive) {
  archive(points_, next_, count_);
  if (next_ >= kKept || count_ > kKept) next_ = count_ = 0;
}

}  // namespace navcal::calib
