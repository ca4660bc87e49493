// SPDX-License-Identifier: Apache-2.0
// The navigator's use of measured velocities.
#include <algorithm>
#include <cmath>

#include "base/durations.h"
#include "base/rotation.h"
#include "nav/navigator.h"

namespace navcal::nav {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Faster is no vehicle, and a greater stated error says that nothing was measured. NaN fails both comparisons.
constexpr double kMostMeasuredSpeed_m_s = 20, kLeastMeasuredStd_m_s = 1e-5, kMostMeasuredStd_m_s = 1;
constexpr double kMostGaugeDepth_m = 12'000;
/// Half the time over which the rates of turn are taken from the attitude. Frames of the card are 50 ms apart.
constexpr std::int64_t kHalfTurn_ns = 100'000'000;

template <bool kOverBottom>
bool is_plausible_velocity(const VelocityReading<kOverBottom>& r) {
  return (r.velocity_m_s.array().abs() <= kMostMeasuredSpeed_m_s).all() && r.std_m_s >= kLeastMeasuredStd_m_s &&
         r.std_m_s <= kMostMeasuredStd_m_s;
}

Eigen::Matrix3d world_from_body(const Pose& pose) {
  return base::rotation_of({pose.roll_rad, pose.pitch_rad, pose.heading_rad});
}

Vector3d in_world(const Vector3d& velocity_m_s, VelocityFrame frame, const Pose& pose) {
  return frame == VelocityFrame::earth ? velocity_m_s : Vector3d(world_from_body(pose) * velocity_m_s);
}

}  // namespace

void Navigator::take(const GroundVelocityReading& reading) {
  const auto pose = pose_for(bottom_ns_, reading.time_ns, is_plausible_velocity(reading));
  if (!pose) return;
  if (!hold(bottom_, reading, *pose, SpeedSource::bottom) || !direction_known(bottom_)) return;
  const auto water_m_s = water_velocity_m_s(*pose);
  if (!water_m_s) return;
  const Vector2d bottom_m_s = in_world(bottom_.velocity_m_s(), bottom_.frame(), *pose).head<2>();
  const double water_std_m_s = water_.current(reading.time_ns) ? water_.std_m_s() : 0;
  if (const auto set =
          set_window_.take(reading.time_ns, bottom_m_s, *water_m_s, std::hypot(bottom_.std_m_s(), water_std_m_s)))
    reckoning_.observe_set(set->set_m_s, set->std_m_s);
}

void Navigator::take(const WaterVelocityReading& reading) {
  const auto pose = pose_for(water_ns_, reading.time_ns, is_plausible_velocity(reading));
  if (!pose) return;
  hold(water_, reading, *pose, SpeedSource::water);
}

void Navigator::take(const DepthReading& reading) {
  const bool plausible = std::abs(reading.depth_m) <= kMostGaugeDepth_m;
  if (!is_new(depth_ns_, reading.time_ns, plausible)) return;
  drive(reading.time_ns);
  const double sunk_m = depth_.sinking_m_s() * base::seconds(*time_ns_ - reading.time_ns);
  correct_depth(reading.depth_m + sunk_m, reading.position_m, reading.std_m);
}

void Navigator::correct_depth(double gauge_m, const Vector3d& position_m, std::optional<double> std_m) {
  // Without a tilt the angles are zero.
  const double depth_m =
      gauge_m - base::depth_below_origin_m(position_m, attitude_.roll_rad(), attitude_.pitch_rad());
  // A gauge in the air, or set to zero while the hull floats aslant, does not lift the origin out of the water.
  const double lifted_m = std::max(0.0, std::min(gauge_m, 0.0) - depth_m);
  if (lifted_m > 0 && std_m) std_m = std::hypot(*std_m, lifted_m);
  depth_.correct(depth_m + lifted_m, std_m);
}

/// Corrects the way since the measurement before: the velocity that was held did not change with time, the true
/// one did, at an even pace.
template <bool kOverBottom>
bool Navigator::hold(HeldVelocity& held, const VelocityReading<kOverBottom>& reading, const Pose& pose,
                     SpeedSource source) {
  const Vector3d arm_m_s = arm_velocity_m_s(pose, reading.position_m, reading.frame);
  const auto step = held.take(reading.time_ns, reading.velocity_m_s - arm_m_s, reading.frame, reading.std_m_s,
                              expected(reading, pose));
  if (!step) return false;
  if (source_ == source && direction_known(held)) {
    const double late_s = std::max(base::seconds(*time_ns_ - reading.time_ns), 0.0);
    const Vector3d change_m_s = in_world(step->change_m_s, reading.frame, pose);
    reckoning_.shift((step->since_s / 2 + late_s) * change_m_s.head<2>());
  }
  return true;
}

Vector3d Navigator::arm_velocity_m_s(const Pose& pose, const Vector3d& position_m, VelocityFrame frame) const {
  if (position_m.isZero(0)) return Vector3d::Zero();
  const auto before = past_.at(pose.time_ns - kHalfTurn_ns), after = past_.at(pose.time_ns + kHalfTurn_ns);
  if (!before || !after) return Vector3d::Zero();
  const Vector3d world_m_s = (world_from_body(*after) - world_from_body(*before)) * position_m /
                             base::seconds(after->time_ns - before->time_ns);
  return frame == VelocityFrame::earth ? world_m_s : Vector3d(world_from_body(pose).transpose() * world_m_s);
}

std::optional<HeldVelocity::Expected> Navigator::expected(const GroundVelocityReading& reading,
                                                          const Pose& pose) const {
  const auto water_m_s = water_velocity_m_s(pose);
  if (!water_m_s) return std::nullopt;
  const Vector2d ground_m_s = *water_m_s + reckoning_.set_m_s();
  const Vector3d level_m_s(ground_m_s.x(), ground_m_s.y(), 0);
  const bool turned = reading.frame == VelocityFrame::body;
  const double speed_std_m_s = options_.reckoning.speed_error * water_m_s->norm();
  return HeldVelocity::Expected{
      turned ? Vector3d(world_from_body(pose).transpose() * level_m_s) : level_m_s,
      std::hypot(std::sqrt(std::max(reckoning_.set_variance_m2_s2(), 0.0)), speed_std_m_s)};
}

std::optional<HeldVelocity::Expected> Navigator::expected(const WaterVelocityReading& reading,
                                                          const Pose& pose) const {
  if (!speed_known_) return std::nullopt;
  const Vector3d ahead_m_s(speed_m_s_, 0, 0);
  if (reading.frame == VelocityFrame::earth && !attitude_.heading_known()) return std::nullopt;
  const bool turned = reading.frame == VelocityFrame::earth;
  return HeldVelocity::Expected{turned ? Vector3d(world_from_body(pose) * ahead_m_s) : ahead_m_s,
                                options_.reckoning.speed_error * speed_m_s_};
}

/// North and east, as far as instruments show it without the velocity over the bottom.
std::optional<Vector2d> Navigator::water_velocity_m_s(const Pose& pose) const {
  if (water_.current(pose.time_ns) && direction_known(water_))
    return in_world(water_.velocity_m_s(), water_.frame(), pose).head<2>();
  if (!speed_known_ || !attitude_.heading_known()) return std::nullopt;
  return in_world({speed_m_s_, 0, 0}, VelocityFrame::body, pose).head<2>();
}

bool Navigator::direction_known(const HeldVelocity& held) const {
  return held.frame() == VelocityFrame::earth || attitude_.heading_known();
}

Vector3d Navigator::measured_m_s(const HeldVelocity& held) const {
  return in_world(held.velocity_m_s(), held.frame(),
                  {0, attitude_.roll_rad(), attitude_.pitch_rad(), attitude_.heading_rad()});
}

const HeldVelocity* Navigator::held_velocity() const {
  if (bottom_.current(*time_ns_)) return &bottom_;
  return water_.current(*time_ns_) ? &water_ : nullptr;
}

std::optional<double> Navigator::speed_through_water_m_s() const {
  if (time_ns_ && water_.current(*time_ns_)) {
    if (water_.frame() == VelocityFrame::body) return water_.velocity_m_s().x();
    if (attitude_.heading_known()) return water_.velocity_m_s().head<2>().dot(ahead());
  }
  return speed_known_ ? std::optional(speed_m_s_) : std::nullopt;
}

std::optional<Vector2d> Navigator::level_velocity_m_s() const {
  if (source_ == SpeedSource::bottom && direction_known(bottom_)) return measured_m_s(bottom_).head<2>();
  if (source_ == SpeedSource::water && direction_known(water_))
    return measured_m_s(water_).head<2>() + reckoning_.set_m_s();
  if (!speed_known_ || !attitude_.heading_known()) return std::nullopt;
  return speed_m_s_ * ahead() + reckoning_.set_m_s();
}

void Navigator::measure(Way& way, const HeldVelocity& held, const Vector3d& before_m_s) const {
  way.source = &held == &bottom_ ? SpeedSource::bottom : SpeedSource::water;
  const Vector2d mean_m_s = (before_m_s + measured_m_s(held)).head<2>() / 2;
  way.speed_known = true;
  way.heading_known = direction_known(held);
  way.speed_m_s = mean_m_s.norm();
  way.ahead = way.speed_m_s > 0 ? Vector2d(mean_m_s / way.speed_m_s) : Vector2d(Vector2d::Zero());
  // Axes in the earth are those of a compass in the instrument, which nobody has calibrated.
  if (held.frame() == VelocityFrame::earth) way.heading_std_rad = options_.heading_error_rad;
  way.heading_std_rad = std::hypot(way.heading_std_rad, options_.velocity.alignment_error_rad);
  way.scale_error = options_.velocity.scale_error;
  // The set that fixes show contains the heading's error on their leg. On another leg part of it points ahead.
  if (way.source == SpeedSource::water) way.scale_error = std::hypot(way.scale_error, way.heading_std_rad / 2);
  way.noise_m2_per_s = held.noise_m2_per_s();
}

}  // namespace navcal::nav
