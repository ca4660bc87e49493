// SPDX-License-Identifier: Apache-2.0
#include "pipeline/nav_reading.h"

#include <cmath>

#include "base/gravity.h"
#include "base/vectors.h"

namespace navcal::pipeline {
namespace {

constexpr double kSecondsPerMinute = 60;
constexpr double kLeastVelocityStd_m_s = 0.001;

template <class Reading>
Reading velocity_reading(const instruments::Sample& sample, instruments::VelocityFrame frame,
                         const instruments::Vector3& velocity_m_s, const std::optional<double>& std_m_s,
                         const Eigen::Vector3d& position_m) {
  Reading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.velocity_m_s = base::vector_of(velocity_m_s);
  reading.frame = frame == instruments::VelocityFrame::body ? nav::VelocityFrame::body : nav::VelocityFrame::earth;
  // No number stays no number, and the navigator leaves it out.
  const double stated_m_s = std_m_s.value_or(kLeastVelocityStd_m_s);
  reading.std_m_s = stated_m_s >= 0 && stated_m_s < kLeastVelocityStd_m_s ? kLeastVelocityStd_m_s : stated_m_s;
  reading.position_m = position_m;
  return reading;
}

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

std::optional<nav::GroundVelocityReading> bottom_reading(const instruments::Sample& sample,
                                                         const instruments::DvlSample& dvl,
                                                         const Eigen::Vector3d& position_m) {
  if (!dvl.bottom_velocity_m_s) return std::nullopt;
  return velocity_reading<nav::GroundVelocityReading>(sample, dvl.frame, *dvl.bottom_velocity_m_s,
                                                      dvl.bottom_velocity_std_m_s, position_m);
}

std::optional<nav::WaterVelocityReading> water_reading(const instruments::Sample& sample,
                                                       const instruments::DvlSample& dvl,
                                                       const Eigen::Vector3d& position_m) {
  if (!dvl.water_velocity_m_s) return std::nullopt;
  return velocity_reading<nav::WaterVelocityReading>(sample, dvl.frame, *dvl.water_velocity_m_s,
                                                     dvl.water_velocity_std_m_s, position_m);
}

std::optional<double> depth_m(const instruments::DepthSample& gauge, const config::NavigationSettings& settings) {
  if (gauge.depth_m || !gauge.pressure_Pa) return gauge.depth_m;
  return (*gauge.pressure_Pa - settings.air_pressure_Pa) / (settings.water_density_kg_m3 * base::kGravity_m_s2);
}

std::optional<double> depth_std_m(const instruments::DepthSample& gauge,
                                  const config::NavigationSettings& settings) {
  if (gauge.depth_m || !gauge.pressure_std_Pa) return gauge.depth_std_m;
  return *gauge.pressure_std_Pa / (settings.water_density_kg_m3 * base::kGravity_m_s2);
}

std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                               const instruments::MotorSample& motor) {
  if (!motor.rpm) return std::nullopt;
  return nav::ShaftReading{sample.stamp.validity_ns, *motor.rpm / kSecondsPerMinute};
}

}  // namespace navcal::pipeline
