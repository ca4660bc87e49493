// SPDX-License-Identifier: Apache-2.0
#include "pipeline/nav_reading.h"

#include <cmath>

#include "base/vectors.h"

namespace navcal::pipeline {
namespace {

constexpr double kSecondsPerMinute = 60;

bool has_fix(const instruments::GpsSample& gps) {
  return gps.fix == instruments::Fix::fix_2d || gps.fix == instruments::Fix::fix_3d;
}

}  // namespace

std::vector<Eigen::Vector3d> mounted_positions_m(const config::Settings& settings) {
  std::vector<Eigen::Vector3d> positions_m;
  for (const auto& port : settings.ports) positions_m.push_back(base::vector_of(port.mounting.position_m));
  return positions_m;
}

bool has_position(const instruments::GpsSample& gps) {
  return has_fix(gps) && gps.latitude_rad && gps.longitude_rad;
}

std::optional<Eigen::Vector2d> ground_velocity_m_s(const instruments::GpsSample& gps) {
  if (!has_fix(gps) || !gps.speed_m_s || !gps.course_rad) return std::nullopt;
  return *gps.speed_m_s * Eigen::Vector2d(std::cos(*gps.course_rad), std::sin(*gps.course_rad));
}

std::optional<nav::RateReading> rate_reading(const instruments::Sample& sample,
                                             const instruments::ImuSample& imu) {
  if (!imu.rate_rad_s) return std::nullopt;
  nav::RateReading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.rate_rad_s = base::vector_of(*imu.rate_rad_s);
  if (imu.specific_force_m_s2) reading.specific_force_m_s2 = base::vector_of(*imu.specific_force_m_s2);
  return reading;
}

std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                               const instruments::MotorSample& motor) {
  if (!motor.rpm) return std::nullopt;
  return nav::ShaftReading{sample.stamp.validity_ns, *motor.rpm / kSecondsPerMinute};
}

}  // namespace navcal::pipeline
