// SPDX-License-Identifier: Apache-2.0
#include "instruments/mounting.h"

#include <variant>

#include "base/angles.h"
#include "base/rotation.h"
#include "base/vectors.h"

namespace navcal::instruments {
namespace {

base::EulerAngles angles_of_mounting(const config::MountingSettings& settings) {
  const auto& [roll_deg, pitch_deg, yaw_deg] = settings.rotation_deg;
  return {roll_deg * base::kRadiansPerDegree, pitch_deg * base::kRadiansPerDegree,
          yaw_deg * base::kRadiansPerDegree};
}

Vector3 turned(const Eigen::Matrix3d& rotation, const Vector3& vector) {
  const Eigen::Vector3d result = rotation * base::vector_of(vector);
  return {result.x(), result.y(), result.z()};
}

}  // namespace

Mounting::Mounting(const config::MountingSettings& settings)
    : turned_(settings.rotation_deg != std::array<double, 3>{}), yaw_rad_(angles_of_mounting(settings).yaw_rad),
      body_from_device_(base::rotation_of(angles_of_mounting(settings))) {}

void Mounting::to_body(decltype(Sample::value)& value) const {
  if (!turned_) return;
  if (auto* compass = std::get_if<CompassSample>(&value)) to_body(*compass);
  if (auto* imu = std::get_if<ImuSample>(&value)) to_body(*imu);
  if (auto* dvl = std::get_if<DvlSample>(&value)) to_body(*dvl);
}

void Mounting::to_body(CompassSample& compass) const {
  if (compass.field_body_uT) compass.field_body_uT = turned(body_from_device_, *compass.field_body_uT);
  if (compass.roll_rad && compass.pitch_rad) {
    // Device in the world times body in the device. Tilt without a heading turns alike with any heading.
    const Eigen::Matrix3d world_from_device =
        base::rotation_of({*compass.roll_rad, *compass.pitch_rad, compass.heading_rad.value_or(0)});
    const base::EulerAngles body = base::angles_of(world_from_device * body_from_device_.transpose());
    compass.roll_rad = body.roll_rad;
    compass.pitch_rad = body.pitch_rad;
    if (compass.heading_rad) compass.heading_rad = base::as_heading(body.yaw_rad);
    return;
  }
  // One angle of two cannot be turned. A heading alone is that of the device's x axis, seen from above.
  compass.roll_rad = compass.pitch_rad = std::nullopt;
  if (compass.heading_rad) compass.heading_rad = base::as_heading(*compass.heading_rad - yaw_rad_);
}

void Mounting::to_body(ImuSample& imu) const {
  if (auto& rate_rad_s = imu.rate_rad_s) {
    // The second, redundant gyro takes the place of the first.
    if (auto& rate_b_rad_s = imu.yaw_rate_b_rad_s)
      rate_b_rad_s = turned(body_from_device_, {(*rate_rad_s)[0], (*rate_rad_s)[1], *rate_b_rad_s})[2];
    rate_rad_s = turned(body_from_device_, *rate_rad_s);
  }
  if (imu.specific_force_m_s2) imu.specific_force_m_s2 = turned(body_from_device_, *imu.specific_force_m_s2);
}

void Mounting::to_body(DvlSample& dvl) const {
  // Velocities in the Earth's axes were turned by the device, with an attitude that it measured itself.
  if (dvl.frame != VelocityFrame::body) return;
  for (auto* velocity_m_s : {&dvl.bottom_velocity_m_s, &dvl.water_velocity_m_s}) {
    if (*velocity_m_s) *velocity_m_s = turned(body_from_device_, **velocity_m_s);
  }
}

}  // namespace navcal::instruments
