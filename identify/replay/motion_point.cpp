// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/replayed_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/angles.h"
#include "base/rotation.h"
#include "sim/layout/restoring.h"

namespace navcal::identify {
namespace {

constexpr double kSteepest_rad = 88 * base::kRadiansPerDegree;
constexpr double kFastest_m_s = 50, kFastestTurn_rad_s = 50;

/// The value of the reading next to a time; nullopt: none within `within_s`.
std::optional<double> next_to(const std::vector<Reading>& readings, double time_s, double within_s) {
  const auto after = std::lower_bound(readings.begin(), readings.end(), time_s,
                                      [](const Reading& reading, double time) { return reading.time_s < time; });
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

void add_lagged_tilt(ReplayedMotion& motion, double lag_s) {
  for (std::size_t k = 0; k < motion.points.size(); ++k) {
    MotionPoint& point = motion.points[k];
    const Eigen::Vector2d now = point.body.euler_rad.head<2>();
    if (lag_s <= 0) {
      point.tilt_rad = now;
    } else if (k > 0) {
      // Exactly, for an input that is linear over the step.
      const MotionPoint& before = motion.points[k - 1];
      const Eigen::Vector2d then = before.body.euler_rad.head<2>();
      const Eigen::Vector2d behind = lag_s / ReplayedMotion::kStep_s * (now - then);
      point.tilt_rad =
          now - behind + std::exp(-ReplayedMotion::kStep_s / lag_s) * (before.tilt_rad - then + behind);
    }
  }
}

MotionPoint ReplayedMotion::at(double time_s) const {
  const double place = std::clamp((time_s - begin_s) / kStep_s, 0.0, static_cast<double>(points.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), points.size() - 2);
  const double s = place - static_cast<double>(i);
  const MotionPoint &a = points[i], &b = points[i + 1];
  MotionPoint point;
  point.body.position_m = a.body.position_m + s * (b.body.position_m - a.body.position_m);
  point.body.euler_rad = a.body.euler_rad + s * (b.body.euler_rad - a.body.euler_rad);
  point.body.velocity = (1 + 2 * s) * (1 - s) * (1 - s) * a.body.velocity +
                        s * (1 - s) * (1 - s) * kStep_s * a.acceleration + s * s * (3 - 2 * s) * b.body.velocity +
                        s * s * (s - 1) * kStep_s * b.acceleration;
  point.acceleration = a.acceleration + s * (b.acceleration - a.acceleration);
  point.tilt_rad = a.tilt_rad + s * (b.tilt_rad - a.tilt_rad);
  return point;
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
