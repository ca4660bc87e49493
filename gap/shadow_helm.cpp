#include "gap/shadow_helm.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/vehicle/autopilot.h"

namespace navcal::gap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Weak, so that what the vehicle does follows from what was reported.
constexpr double kRudderPerHeading = 0.3, kRudderPerRate_s = 0.15;
constexpr double kPitchPerDepth_m = 0.15, kElevatorPerPitch = 0.4, kElevatorPerRate_s = 0.2;
constexpr double kMostPitch_rad = 8 * kDegree, kMost_rad = 6 * kDegree;

double bounded(double value, double bound) { return std::clamp(value, -bound, bound); }

}  // namespace

ShadowHelm::ShadowHelm(std::span<const ActuatorTrack::Row> rows, std::vector<Vector3> servos_rad,
                       const Course10Hz& course, const config::FinSettings& fins)
    : rows_(rows), servos_rad_(std::move(servos_rad)), course_(course), fins_(fins) {}

std::size_t ShadowHelm::row_at(double time_s) const {
  if (time_s <= course_.time_s.front()) return 0;
  const auto row = static_cast<std::size_t>((time_s - course_.time_s.front()) / kInterval_s);
  return std::min(row, course_.time_s.size() - 1);
}

sim::Body ShadowHelm::start() const {
  sim::Body body;
  body.position_m.z() = course_.depth_m.front();
  body.euler_rad = {course_.roll_rad.front(), course_.pitch_rad.front(), course_.heading_rad.front()};
  body.velocity[0] = course_.surge_m_s.front();
  return body;
}

sim::Actuators ShadowHelm::actuators_at_start() const {
  const auto& fins = servos_rad_.front();
  return {{fins[0], fins[1], fins[2]}, rows_.front().shaft_rps, rows_.front().shaft_rps};
}

sim::Actuators ShadowHelm::next(double time_s, double step_s, const sim::Body& body) {
  const std::size_t at = row_at(time_s);
  const double turned = std::remainder(course_.heading_rad[at] - body.euler_rad[2], 2 * std::numbers::pi);
  const double rudder =
      kRudderPerHeading * turned + kRudderPerRate_s * (course_.yaw_rate_rad_s[at] - body.velocity[5]);
  const double pitch_wanted =
      course_.pitch_rad[at] -
      bounded(kPitchPerDepth_m * (course_.depth_m[at] - body.position_m.z()), kMostPitch_rad);
  const double elevator = kElevatorPerPitch * (pitch_wanted - body.euler_rad[1]) +
                          kElevatorPerRate_s * (course_.pitch_rate_rad_s[at] - body.velocity[4]);
  const double follows = -std::expm1(-step_s / fins_.lag_s);
  rudder_rad_ += follows * (bounded(rudder, kMost_rad) - rudder_rad_);
  elevator_rad_ += follows * (bounded(elevator, kMost_rad) - elevator_rad_);

  const auto row = static_cast<std::size_t>(std::lround((time_s + step_s) / ActuatorTrack::kStep_s));
  finished_ = row >= rows_.size();
  const double shaft_rps = rows_[std::min(row, rows_.size() - 1)].shaft_rps;
  const Vector3& servos_rad = servos_rad_[std::min(row, rows_.size() - 1)];
  Eigen::Vector3d fins_rad = sim::mixed_fins(rudder_rad_, elevator_rad_);
  for (Eigen::Index i = 0; i < 3; ++i) {
    fins_rad[i] = bounded(fins_rad[i] + servos_rad[static_cast<std::size_t>(i)], fins_.limit_rad);
  }
  return {fins_rad, shaft_rps, shaft_rps};
}

}  // namespace navcal::gap
