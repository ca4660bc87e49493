// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/motion_point.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/angles.h"
#include "base/rotation.h"

namespace navcal::identify {
namespace {

constexpr double kSteepest_rad = 88 * base::kRadiansPerDegree;
constexpr double kFastest_m_s = 50, kFastestTurn_rad_s = 50;

/// The value of the reading next to a time; nullopt: none within `within_s`.
std::optional<double> next_to(const std::vector<Reading>& readings, double time_s, double within_s) {
  const auto after = std::ranges::lower_bound(readings, time_s, {}, &Reading::time_s);
  std::optional<double> value;
  double nearest_s = within_s;
  const auto consider = [&](const Reading& reading) {
    if (std::abs(reading.time_s - time_s) > nearest_s) return;
    nearest_s = std::abs(reading.time_s - time_s);
    value = reading.value;
  };
  if (after != readings.end()) consider(*after);
  if (after != readings.begin()) consider(*(after - 1));
  return value;
}

}  // namespace

bool is_sane(const sim::Body& body) {
  // Written so that NaN is not.
  return body.velocity.head<3>().cwiseAbs().maxCoeff() < kFastest_m_s &&
         body.velocity.tail<3>().cwiseAbs().maxCoeff() < kFastestTurn_rad_s &&
         std::abs(body.euler_rad.y()) < kSteepest_rad && body.position_m.allFinite() && body.velocity.allFinite();
}

Eigen::Matrix3d world_from_body(const Eigen::Vector3d& euler_rad) {
  return base::rotation_of({euler_rad.x(), euler_rad.y(), euler_rad.z()});
}

MotionPoint point_of(const StateVector& state) {
  MotionPoint point;
  point.body = {state.segment<3>(0), state.segment<3>(3), state.segment<6>(6)};
  point.tilt_rad = state.tail<2>();
  return point;
}

Eigen::Vector2d lagged_tilt(const Eigen::Vector2d& shown, const Eigen::Vector2d& then, const Eigen::Vector2d& now,
                            double lag_s, double step_s) {
  if (lag_s <= 0) return now;
  const Eigen::Vector2d behind = lag_s / step_s * (now - then);
  return now - behind + std::exp(-step_s / lag_s) * (shown - then + behind);
}

void measure_state(const RecordedMotion& motion, double time_s, StateVector& now) {
  constexpr double kNear_s = 1, kFixNear_s = 3;
  const auto set = [&](Eigen::Index state, Channel channel, double within_s) {
    const auto value = next_to(motion[channel], time_s, within_s);
    if (value) now[state] = *value;
    return value.has_value();
  };
  set(0, Channel::north, kFixNear_s);
  set(1, Channel::east, kFixNear_s);
  if (!set(2, Channel::gauge_depth, kNear_s)) set(2, Channel::depth, kNear_s);
  set(3, Channel::roll, kNear_s);
  set(4, Channel::pitch, kNear_s);
  set(5, Channel::heading, kNear_s);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const auto after = [&](Channel first) { return static_cast<Channel>(static_cast<std::size_t>(first) + axis); };
    if (!set(6 + i, after(Channel::water_x), kNear_s)) set(6 + i, after(Channel::bottom_x), kNear_s);
    set(9 + i, after(Channel::rate_x), kNear_s);
  }
  now.tail<2>() = now.segment<2>(3);
}

}  // namespace navcal::identify
