// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/trajectory_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "autopilot/autopilot.h"
#include "base/angles.h"

namespace navcal::gap {
namespace {

// Weak gains, so that the motion follows from the reported angles.
constexpr double kRudderPerHeading = 0.3, kRudderPerRate_s = 0.15;
constexpr double kPitchPerDepth_m = 0.15, kElevatorPerPitch = 0.4, kElevatorPerRate_s = 0.2;
constexpr double kMostPitch_rad = 8 * base::kRadiansPerDegree, kMost_rad = 6 * base::kRadiansPerDegree;

double bounded(double value, double bound) { return std::clamp(value, -bound, bound); }

}  // namespace

TrajectoryTracker::TrajectoryTracker(std::span<const ActuatorTrack::Row> rows, std::vector<Vector3> servos_rad,
                                     const Trajectory10Hz& course, const config::FinSettings& fins)
    : rows_(rows), servos_rad_(std::move(servos_rad)), course_(course), fins_(fins) {}

// The record is interpolated: a staircase of ten steps a second would make the fins ripple in step with the
// card's reports. The reports would always sample the same side of the ripple. In a steady turn they would show
// a rudder that is thirds of a per cent too small.
TrajectoryTracker::Wanted TrajectoryTracker::wanted_at(double time_s) const {
  const double place = std::clamp((time_s - course_.time_s.front()) / kInterval_s, 0.0,
                                  static_cast<double>(course_.time_s.size() - 1));
  const auto before = static_cast<std::size_t>(place);
  const std::size_t after = std::min(before + 1, course_.time_s.size() - 1);
  const double part = place - static_cast<double>(before);
  const auto between = [&](const std::vector<double>& of) { return of[before] + part * (of[after] - of[before]); };
  const double turn_rad =
      std::remainder(course_.heading_rad[after] - course_.heading_rad[before], 2 * std::numbers::pi);
  return {course_.heading_rad[before] + part * turn_rad, between(course_.yaw_rate_rad_s),
          between(course_.pitch_rad), between(course_.pitch_rate_rad_s), between(course_.depth_m)};
}

sim::Body TrajectoryTracker::start() const {
  sim::Body body;
  body.position_m.z() = course_.depth_m.front();
  body.euler_rad = {course_.roll_rad.front(), course_.pitch_rad.front(), course_.heading_rad.front()};
  body.velocity[0] = course_.surge_m_s.front();
  return body;
}

sim::Actuators TrajectoryTracker::actuators_at_start() const {
  const auto& fins = servos_rad_.front();
  return {{fins[0], fins[1], fins[2]}, rows_.front().shaft_rps, rows_.front().shaft_rps};
}

sim::Actuators TrajectoryTracker::next(double time_s, double step_s, const sim::Body& body) {
  const Wanted wanted = wanted_at(time_s);
  const double turned = std::remainder(wanted.heading_rad - body.euler_rad[2], 2 * std::numbers::pi);
  const double rudder = kRudderPerHeading * turned + kRudderPerRate_s * (wanted.yaw_rate_rad_s - body.velocity[5]);
  const double pitch_wanted =
      wanted.pitch_rad - bounded(kPitchPerDepth_m * (wanted.depth_m - body.position_m.z()), kMostPitch_rad);
  const double elevator = kElevatorPerPitch * (pitch_wanted - body.euler_rad[1]) +
                          kElevatorPerRate_s * (wanted.pitch_rate_rad_s - body.velocity[4]);
  const double follows = -std::expm1(-step_s / fins_.lag_s);
  rudder_rad_ += follows * (bounded(rudder, kMost_rad) - rudder_rad_);
  elevator_rad_ += follows * (bounded(elevator, kMost_rad) - elevator_rad_);

  const auto row = static_cast<std::size_t>(std::lround((time_s + step_s) / ActuatorTrack::kStep_s));
  finished_ = row >= rows_.size();
  const double shaft_rps = rows_[std::min(row, rows_.size() - 1)].shaft_rps;
  const Vector3& servos_rad = servos_rad_[std::min(row, rows_.size() - 1)];
  Eigen::Vector3d fins_rad = autopilot::mixed_fins(rudder_rad_, elevator_rad_);
  for (Eigen::Index i = 0; i < 3; ++i) {
    fins_rad[i] = bounded(fins_rad[i] + servos_rad[static_cast<std::size_t>(i)], fins_.limit_rad);
  }
  return {fins_rad, shaft_rps, shaft_rps};
}

}  // namespace navcal::gap
