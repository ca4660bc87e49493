// SPDX-License-Identifier: Apache-2.0
#include "nav/attitude.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace navcal::nav {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// No gyro's zero is further off: what asks for more is not its zero.
constexpr double kMostZero_rad_s = 0.05;
/// After a pause one reading says no more of the zeros than this.
constexpr double kLongestStep_s = 1;

Quaterniond rotation(const Vector3d& angle_rad) {
  const double angle = angle_rad.norm();
  if (angle < 1e-12) return Quaterniond::Identity();
  return Quaterniond(AngleAxisd(angle, angle_rad / angle));
}

double share(double gain_per_s, double since_s) { return -std::expm1(-gain_per_s * since_s); }

}  // namespace

void Attitude::turn(const Vector3d& rate_rad_s, double duration_s) {
  // Without an inclinometer nothing would hold roll and pitch; the vehicle is stable, so that level is the best
  // guess.
  const Vector3d rate =
      tilt_known_ ? Vector3d(rate_rad_s + zero_rad_s_) : Vector3d(0, 0, rate_rad_s.z() + zero_rad_s_.z());
  world_from_body_ = (world_from_body_ * rotation(rate * duration_s)).normalized();
  read_angles();
}

void Attitude::lose_track() { heading_tracked_ = tilt_tracked_ = false; }

double Attitude::correct_heading(double difference_rad, double since_s) {
  double change_rad = difference_rad;
  if (heading_tracked_) {
    change_rad *= share(options_.heading_gain_per_s, since_s);
    const Vector3d down_body = world_from_body_.conjugate() * Vector3d::UnitZ();
    learn_zero(options_.heading_zero_gain_per_s2 * difference_rad * std::min(since_s, kLongestStep_s) * down_body);
  }
  heading_known_ = heading_tracked_ = true;
  set(roll_rad_, pitch_rad_, heading_rad_ + change_rad);
  return change_rad;
}

Eigen::Vector2d Attitude::correct_tilt(double roll_difference_rad, double pitch_difference_rad, double since_s) {
  Eigen::Vector2d change(roll_difference_rad, pitch_difference_rad);
  if (tilt_tracked_) {
    change *= share(options_.tilt_gain_per_s, since_s);
    // Body rates of changing roll and pitch (Fossen, Handbook of Marine Craft, 2.2).
    const Vector3d turned(roll_difference_rad, pitch_difference_rad * std::cos(roll_rad_),
                          -pitch_difference_rad * std::sin(roll_rad_));
    learn_zero(options_.tilt_zero_gain_per_s2 * std::min(since_s, kLongestStep_s) * turned);
  }
  tilt_known_ = tilt_tracked_ = true;
  set(roll_rad_ + change.x(), pitch_rad_ + change.y(), heading_rad_);
  return change;
}

void Attitude::set(double roll_rad, double pitch_rad, double heading_rad) {
  world_from_body_ = AngleAxisd(heading_rad, Vector3d::UnitZ()) * AngleAxisd(pitch_rad, Vector3d::UnitY()) *
                     AngleAxisd(roll_rad, Vector3d::UnitX());
  read_angles();
}

void Attitude::read_angles() {
  const auto& q = world_from_body_;
  roll_rad_ = std::atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y()));
  pitch_rad_ = std::asin(std::clamp(2 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0));
  heading_rad_ = std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

void Attitude::learn_zero(const Vector3d& change_rad_s) {
  zero_rad_s_ = (zero_rad_s_ + change_rad_s).cwiseMax(-kMostZero_rad_s).cwiseMin(kMostZero_rad_s);
}

}  // namespace navcal::nav
