// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/error_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "gap/data/innovations.h"

namespace navcal::gap {
namespace {

using Place = ErrorPlace;

constexpr double kErrorDegree_rad = 1 / base::kDegreesPerRadian;
constexpr double kDegrees = base::kDegreesPerRadian;

constexpr std::array<ErrorComponent, 3> kField{{{"x", Place::field_x, 1, "compass.field", "uT"},
                                                {"y", Place::field_y, 1, "compass.field", "uT"},
                                                {"z", Place::field_z, 1, "compass.field", "uT"}}};
constexpr std::array<ErrorComponent, 1> kHeading{
    {{"heading", Place::heading, 2 * kErrorDegree_rad, "compass.heading", "deg", kDegrees}}};
constexpr std::array<ErrorComponent, 2> kTilt{
    {{"roll", Place::tilt_roll, kErrorDegree_rad, "compass.tilt", "deg", kDegrees},
     {"pitch", Place::tilt_pitch, kErrorDegree_rad, "compass.tilt", "deg", kDegrees}}};
constexpr std::array<ErrorComponent, 4> kGyro{
    {{"ax", Place::gyro_ax, 0.3 * kErrorDegree_rad, "imu.gyro", "deg/s", kDegrees},
     {"az", Place::gyro_az, 0.3 * kErrorDegree_rad, "imu.gyro", "deg/s", kDegrees},
     {"by", Place::gyro_by, 0.3 * kErrorDegree_rad, "imu.gyro", "deg/s", kDegrees},
     {"bz", Place::gyro_bz, 0.3 * kErrorDegree_rad, "imu.gyro", "deg/s", kDegrees}}};
constexpr std::array<ErrorComponent, 3> kAccel{{{"x", Place::force_x, 0.1, "imu.accel", "m/s2"},
                                                {"y", Place::force_y, 0.1, "imu.accel", "m/s2"},
                                                {"z", Place::force_z, 0.1, "imu.accel", "m/s2"}}};
constexpr std::array<ErrorComponent, 1> kDepth{{{"depth", Place::depth, 0.1, "imu.depth", "m"}}};
constexpr std::array<ErrorComponent, 4> kReceiver{
    {{"north", Place::position_north, 1, "gps.position", "m"},
     {"east", Place::position_east, 1, "gps.position", "m"},
     {"north_velocity", Place::velocity_north, 0.1, "gps.velocity", "m/s"},
     {"east_velocity", Place::velocity_east, 0.1, "gps.velocity", "m/s"}}};
constexpr std::array<ErrorComponent, 2> kCurrent{{{"north", Place::current_north, 0.06, "gps.velocity", "m/s"},
                                                  {"east", Place::current_east, 0.06, "gps.velocity", "m/s"}}};
constexpr std::array<ErrorComponent, 1> kThrust{
    {{"surge", Place::thrust, 0.08, "vehicle.speed", "of the thrust"}}};
constexpr std::array<ErrorComponent, 3> kFins{
    {{"yaw", Place::rudder, kErrorDegree_rad, "vehicle.yaw_rate", "deg of fin", kDegrees},
     {"pitch", Place::elevator, kErrorDegree_rad, "vehicle.pitch_rate", "deg of fin", kDegrees},
     {"roll", Place::ailerons, kErrorDegree_rad, "", "deg of fin", kDegrees}}};
constexpr std::array<ErrorComponent, 1> kHeave{{{"heave", Place::heave, 0.4, "vehicle.depth_rate", "N"}}};

constexpr std::array<ErrorSource, 11> kSources{
    {{"compass.field", "the compass's magnetic field", kField, true},
     {"compass.heading", "the compass's heading", kHeading, true},
     {"compass.tilt", "the inclinometer", kTilt},
     {"imu.gyro", "the rate gyros", kGyro, false, true},
     {"imu.accel", "the accelerometers", kAccel},
     {"imu.depth", "the depth gauge", kDepth},
     {"gps", "the GPS receiver", kReceiver, true},
     {"water.current", "the current of the water", kCurrent},
     {"vehicle.thrust", "the force along the vehicle", kThrust, false, false, true},
     {"vehicle.moments", "the moments on the vehicle", kFins, false, false, true},
     {"vehicle.heave", "the vertical force on the vehicle", kHeave, false, false, true}}};

/// Directions of the three fins that make a moment about z, y and x (docs/simulator.md: how rudder and elevator
/// mix).
constexpr double kShare = std::numbers::sqrt3 / 2;
constexpr std::array<sim::Vector3, 3> kMixing{{{-1, 0.5, 0.5}, {0, kShare, -kShare}, {1, 1, 1}}};

}  // namespace

std::span<const ErrorSource> error_sources() { return kSources; }

TimedError::TimedError(ErrorPlace place, std::shared_ptr<const Eigen::VectorXd> series, double begin_s)
    : place_(place), series_(std::move(series)), begin_s_(begin_s) {}

double TimedError::at(double time_s) const {
  const auto last = static_cast<double>(series_->size() - 1);
  const double place = std::clamp((time_s - begin_s_) / kInterval_s, 0.0, last);
  const auto i = static_cast<Eigen::Index>(place);
  const Eigen::Index next = std::min(i + 1, series_->size() - 1);
  const double part = place - static_cast<double>(i);
  return p_[0] * ((1 - part) * (*series_)[i] + part * (*series_)[next]);
}

void TimedError::earth_field(const sim::Instant& now, sim::Vector3& field_world_uT) {
  if (place_ != Place::heading) return;
  // A compass that shows too large a heading sees a field that is turned to the west.
  const double angle_rad = -at(now.time_s);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto [north, east, down] = field_world_uT;
  field_world_uT = {c * north - s * east, s * north + c * east, down};
}

void TimedError::body_field(const sim::Instant& now, sim::Vector3& field_body_uT) {
  if (const std::size_t i = index_from(Place::field_x); i < 3) field_body_uT[i] += at(now.time_s);
}

void TimedError::tilt_said(const sim::Instant& now, sim::Tilt& tilt) {
  if (place_ == Place::tilt_roll) tilt.roll_rad += at(now.time_s);
  if (place_ == Place::tilt_pitch) tilt.pitch_rad += at(now.time_s);
}

void TimedError::gyros(const sim::Instant& now, sim::GyroRates& rate_rad_s) {
  if (const std::size_t i = index_from(Place::gyro_ax); i < 4) rate_rad_s[i] += at(now.time_s);
}

void TimedError::accelerometers(const sim::Instant& now, sim::Vector3& force_m_s2) {
  if (const std::size_t i = index_from(Place::force_x); i < 3) force_m_s2[i] += at(now.time_s);
}

void TimedError::depth(const sim::Instant& now, double& depth_m) {
  if (place_ == Place::depth) depth_m += at(now.time_s);
}

void TimedError::antenna(const sim::Instant& now, sim::AntennaMotion& motion) {
  if (const std::size_t i = index_from(Place::position_north); i < 2) motion.position_m[i] += at(now.time_s);
  if (const std::size_t i = index_from(Place::velocity_north); i < 2) motion.velocity_m_s[i] += at(now.time_s);
}

void TimedError::influence(double time_s, sim::Influences& on) {
  if (const std::size_t i = index_from(Place::current_north); i < 2) on.current_m_s[i] += at(time_s);
  if (place_ == Place::thrust) on.thrust_factor += at(time_s);
  if (place_ == Place::heave) on.buoyancy_N += at(time_s);
}

void TimedError::link_fins(double time_s, double /*step_s*/, sim::Vector3& fins_rad) {
  if (const std::size_t i = index_from(Place::rudder); i < 3) sim::add_scaled(fins_rad, at(time_s), kMixing[i]);
}

}  // namespace navcal::gap
