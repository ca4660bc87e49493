// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/predicted_readings.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/angles.h"
#include "base/gravity.h"

namespace navcal::identify {
namespace {

double component(Channel channel, Channel first, const Eigen::Vector3d& vector) {
  return vector[static_cast<Eigen::Index>(channel) - static_cast<Eigen::Index>(first)];
}

}  // namespace

void PredictedReadings::at(const MotionPoint& point, const Eigen::Vector3d& carried_m,
                           std::span<const ChannelReading> readings, const Calibration& calibration,
                           double* out) const {
  const auto value = [&](Nuisance nuisance) { return get(calibration, nuisance); };
  const auto vector = [&](Nuisance first) {
    return Eigen::Vector3d(calibration.segment<3>(static_cast<Eigen::Index>(first)));
  };
  const Eigen::Vector3d current = current_of(calibration);
  const Eigen::Vector3d imu_turn = vector(Nuisance::imu_turn_x);
  const Eigen::Matrix3d doppler_from_body =
      Eigen::AngleAxisd(-value(Nuisance::doppler_turn), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const sim::Body& body = point.body;
  const Eigen::Matrix3d R = world_from_body(body.euler_rad);
  const Eigen::Vector3d v = body.velocity.head<3>(), omega = body.velocity.tail<3>();
  const Eigen::Vector3d antenna_m =
      recorded_.antenna_place_m + Eigen::Vector3d(value(Nuisance::antenna_x), value(Nuisance::antenna_y), 0);
  const double depth_per_m = 1 + value(Nuisance::depth_scale);
  const Eigen::Vector3d force = specific_force(point, R.row(2).transpose(), recorded_.imu_place_m);
  const std::array<double, 4> rate_errors = errors_.of_rates(body, force);
  const auto predict = [&](Channel channel, double time_s) -> double {
    switch (channel) {
      case Channel::rate_x:
      case Channel::rate_y:
      case Channel::rate_z: {
        const Eigen::Vector3d turned = omega - imu_turn.cross(omega);
        const Eigen::Vector3d all = turned + vector(Nuisance::rate_scale_x).cwiseProduct(turned);
        return rate_errors[static_cast<std::size_t>(channel)] +
               component(channel, Channel::rate_x,
                         all + vector(Nuisance::rate_bias_x) + time_s * vector(Nuisance::rate_drift_x));
      }
      case Channel::second_yaw_rate: {
        const Eigen::Vector3d turned = omega - imu_turn.cross(omega);
        return (1 + value(Nuisance::second_yaw_rate_scale)) * turned.z() + value(Nuisance::second_yaw_rate_bias) +
               rate_errors.back();
      }
      case Channel::force_x:
      case Channel::force_y:
      case Channel::force_z: {
        const Eigen::Vector3d turned = force - imu_turn.cross(force);
        const Eigen::Vector3d all = turned + vector(Nuisance::force_scale_x).cwiseProduct(turned);
        return component(channel, Channel::force_x, all + vector(Nuisance::force_bias_x));
      }
      case Channel::roll: return point.tilt_rad.x() + value(Nuisance::roll_offset);
      case Channel::pitch: return point.tilt_rad.y() + value(Nuisance::pitch_offset);
      case Channel::heading: {
        Eigen::Vector3d euler_rad = body.euler_rad;
        euler_rad.z() += value(Nuisance::heading_offset);
        double heading = euler_rad.z();
        // A device that tilts without a lag levels the field exactly.
        if (recorded_.tilt_lag_s > 0 || !errors_.empty()) {
          Eigen::Vector3d field = field_in_body(euler_rad, recorded_.dip_rad + value(Nuisance::dip));
          if (recorded_.field_uT > 0) field = errors_.shown_field(recorded_.field_uT * field);
          heading = levelled_heading(
              field, recorded_.tilt_lag_s > 0 ? point.tilt_rad : Eigen::Vector2d(euler_rad.head<2>()));
        }
        return heading + value(Nuisance::heading_sine) * std::sin(heading) +
               value(Nuisance::heading_cosine) * std::cos(heading);
      }
      case Channel::depth:
        return depth_per_m * (body.position_m.z() + R.row(2).dot(recorded_.imu_place_m)) +
               value(Nuisance::depth_offset);
      case Channel::gauge_depth:
        return depth_per_m * (body.position_m.z() + R.row(2).dot(recorded_.gauge_place_m)) +
               value(Nuisance::gauge_offset);
      case Channel::bottom_x:
      case Channel::bottom_y:
      case Channel::bottom_z: {
        const Eigen::Vector3d there = v + omega.cross(recorded_.doppler_place_m) + R.transpose() * current;
        return component(channel, Channel::bottom_x,
                         (1 + value(Nuisance::doppler_scale)) * (doppler_from_body * there));
      }
      case Channel::water_x:
      case Channel::water_y:
      case Channel::water_z: {
        const Eigen::Vector3d there = v + omega.cross(recorded_.doppler_place_m);
        return component(channel, Channel::water_x,
                         (1 + value(Nuisance::doppler_scale)) * (doppler_from_body * there));
      }
      case Channel::north:
      case Channel::east: {
        const Eigen::Vector3d there = body.position_m + R * antenna_m + carried_m;
        return component(channel, Channel::north, there);
      }
      case Channel::north_velocity:
      case Channel::east_velocity: {
        const Eigen::Vector3d there = R * (v + omega.cross(antenna_m)) + current;
        return component(channel, Channel::north_velocity, there);
      }
    }
    return 0;
  };
  for (const ChannelReading& reading : readings) *out++ = predict(reading.channel, reading.time_s);
}

}  // namespace navcal::identify
